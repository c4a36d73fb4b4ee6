// Which addresses are unsafe to ask for, by the rule where the options have no other.
import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { unsafeRule, wordsOf } from "./unsafe.js";

const isUnsafe = (address: string) => wordsOf(new URL(address, "https://example.com")).search(unsafeRule()) >= 0;

const UNSAFE = `/logout /log-out /log_out /users/sign_out /signout.php /account/logOff /auth/logout?next=/ /wp-login.php?action=logout
  /log/out /%6Cogout /LOGOUT /index.php?do=signoff /api/logoutUser /cart /cart/ /shop/cart.aspx /my-cart /cart2 /basket /checkout/step-1 /addToCart?id=3
  /?add-to-cart=27 /?remove_item=3 /remove-from-list /unsubscribe?u=1 /mail/unsubscribe /posts/5/delete /posts/delete/5 /delete.php?id=3
  /deletePost?id=3 /delete_user/5 /?action=trash&post=1 /polls/3/vote/ /item?vote=up /users/confirmation?confirmation_token=x
  /wp-admin/edit.php?_wpnonce=aa /reset/abc /subscribe /buy/3 /pay?id=1 /cancel-order/3 /orders/3/cancel /x?do=remove /toggle/dark
  /friends/42/follow /export.php /print?id=3 /verify/abc`;

const SAFE = `/ /about /blog/how-to-log-a-bug /logs /login /sign-in /signup /catalogue /cartoons /cartography /scarthing /carte
  /news/2026/delta /blogs/outdoors /products?page=2&sort=price /search?q=likely /deleted-scenes /payments-history /users/42 /orders/3
  /printers /verification /category/banking /restaurants /blockchain /followers /markdown /pins /sender /docs/api/tokens /topics/voting
  /analog-outputs /dialog/output /assign/office /marketing /saved /cancellation-policy /buyers-guide /new-add-ons`;

const words = (list: string) => list.trim().split(/\s+/);

describe("unsafe addresses", () => {
  for (const address of words(UNSAFE)) test(`${address} is never asked for`, () => assert.ok(isUnsafe(address)));
  for (const address of words(SAFE)) test(`${address} may be`, () => assert.ok(!isUnsafe(address)));

  test("an address that is no UTF-8 is read as it is", () => {
    assert.ok(!isUnsafe("/caf%E9"));
    assert.ok(isUnsafe("/caf%E9/logout"));
  });
});
