// whither/links on a real server: which requests are made early and used, early and wasted, cancelled; by each mechanism.
import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { hosted, linksTo, open, until } from "./links-site.mjs";

/** Removes features before the page's scripts run. */
const WITHOUT_RULES = () => {
  const supports = HTMLScriptElement.supports;
  HTMLScriptElement.supports = (type) => type !== "speculationrules" && supports(type);
};
const WITHOUT_LINK = () => {
  HTMLScriptElement.supports = () => false;
  DOMTokenList.prototype.supports = () => false;
};

/** Each mechanism with what the browser is left with, and what it asks for. */
const MECHANISMS = [
  { mechanism: "rules", init: undefined, dest: "document" },
  { mechanism: "link", init: WITHOUT_RULES, dest: "empty" },
  { mechanism: "fetch", init: WITHOUT_LINK, dest: "empty" },
];

for (const { mechanism, init, dest } of MECHANISMS) {
  describe(`links by ${mechanism}`, () => {
    const site = hosted();

    it("early and used: one request, before the pointer is there, and none when the link is followed", async (t) => {
      const body = linksTo("/a?max-age=60", "/b?max-age=60", "/c?max-age=60");
      const { page, reach, hand, prefetches } = await open(t, site, body, { init, options: "keep: 0" });
      const to = await reach("a:nth-of-type(3)");
      await until("the request", () => site.requests.length > 0 && site.requests.every(({ ended }) => ended === "sent"));
      assert.equal(await page.evaluate(() => document.querySelector("a:hover")), null, "it is early");
      const [{ url, probability, reason, ...made }] = await prefetches();
      assert.deepEqual(made, { mechanism });
      assert.deepEqual([url, reason], [`${site.url}/c?max-age=60`, "pointer"]);
      assert.ok(probability > 0.8, probability);
      await hand.play([[0, to.x, to.y]]);
      await hand.press(to);
      await page.waitForURL("**/c?*");
      await until("the beacon", () => site.posted.length > 0);
      assert.deepEqual(
        site.requests.map(({ path, purpose, dest }) => ({ path, purpose, dest })),
        [{ path: "/c?max-age=60", purpose: "prefetch", dest }],
      );
      const { lead, ...counts } = site.posted[0];
      assert.deepEqual(counts, { requested: 1, used: 1, wasted: 0, cancelled: 0, failed: 0, running: 0, prerendered: 0 });
      assert.ok(lead > 0 && lead < 10_000, `lead ${lead}`);
    });

    it("cancelled: what is on its way is aborted when the pointer turns away, and asked for again later", async (t) => {
      const { page, reach, turnAway, stats } = await open(t, site, linksTo("/a?wait=60000", "/b"), {
        init,
        options: "keep: 60000",
      });
      await turnAway(await reach("a"));
      await until("the abort", () => site.requests.length > 0 && site.requests.every(({ ended }) => ended === "aborted"));
      const { lead, requested, cancelled, ...counts } = await stats();
      assert.deepEqual(counts, { used: 0, wasted: 0, failed: 0, running: 0, prerendered: 0 });
      // more than one where this machine is too busy for one movement
      assert.ok(requested > 0 && requested === cancelled, `${cancelled} of ${requested}`);
      assert.equal(lead, null);
      assert.equal(await page.locator("script[type=speculationrules], link[rel=prefetch]").count(), 0);
      const made = site.requests.length;
      await reach("a");
      await until("the next request", () => site.requests.length > made);
      assert.deepEqual(await page.evaluate(() => errors), []);
    });

    it("early and wasted: what is there is kept, asked for no more, and used if the user comes back", async (t) => {
      const { page, reach, turnAway, hand, stats } = await open(t, site, linksTo("/a?max-age=60", "/b"), {
        init,
        options: "keep: 0",
      });
      await turnAway(await reach("a"));
      await until("the answer", () => site.requests[0]?.ended === "sent");
      await until("that it is known", async () => (await stats()).wasted === 1);
      assert.equal((await stats()).requested, 1);
      const to = await reach("a", 1);
      await until("that it is meant again", async () => (await stats()).running === 1);
      await hand.press(to);
      await page.waitForURL("**/a?*");
      await until("the beacon", () => site.posted.length > 0);
      assert.equal(site.requests.length, 1);
      const { requested, used, wasted, cancelled } = site.posted[0];
      assert.deepEqual({ requested, used, wasted, cancelled }, { requested: 1, used: 1, wasted: 0, cancelled: 0 });
    });
  });
}
