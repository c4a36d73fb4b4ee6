/**
 * Addresses that are unsafe to ask for before the user does: what they do, or may do, is done by asking.
 *
 * @module
 */

/** Anywhere, as words: they end the session, or show or change what is about to be bought. */
const ANYWHERE = "(log|sign)[^a-z]?(out|off)|(add|remove)[^a-z]?(to|from)|unsubscribe|cart|basket|checkout";

/** At the beginning of a segment of the path, of a name or a value of the query: they change something, or may be used once. */
const FIRST =
  "accept|activate|approve|ban|block|buy|cancel|claim|clear|confirm|deactivate|decline|delete|deny|destroy|disable|disconnect|" +
  "downvote|empty|enable|erase|export|follow|impersonate|invalidate|like|mark|mute|otp|pay|payment|pin|print|publish|purchase|" +
  "purge|redeem|reject|remove|reset|restart|restore|revoke|save|send|submit|subscribe|switch|terminate|toggle|token|trash|undo|" +
  "unfollow|unlike|unpublish|update|upload|upvote|verify|vote|withdraw";

/** At the end of a name in the query: what follows is used once. */
const LAST = "(token|nonce|otp|csrf)=";

/** The rule where the options have no other. */
export function unsafeRule(): RegExp {
  return new RegExp(`(?<![a-z])(${ANYWHERE})(?![a-z])|[/?&=](${FIRST})(?![a-z])|${LAST}`);
}

/** Path and query as the rule reads them: decoded, in lower case, `logOut` as `log-out`. */
export function wordsOf({ pathname, search }: URL): string {
  let text = pathname + search;
  try {
    text = decodeURIComponent(text);
  } catch {
    // not UTF-8: as it is
  }
  return text.replace(/([a-z])([A-Z])/g, "$1-$2").toLowerCase();
}
