// Which links whither/links asks for, and how often: exclusions, connections, limits, policies, live selectors, and what is left after.
import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { hosted, linksTo, open, until } from "./links-site.mjs";

/**
 * Moves onto a link until it is meant; then the page has asked for these documents and no others. On a machine that is too busy a movement
 * may be two, and what is taken back in between is asked for twice.
 */
async function asks(site, opened, target, expected) {
  await opened.reach(target, 1);
  await until("that it is meant", () => opened.page.evaluate(() => ahead.watcher.getSnapshot().intended.length > 0));
  const wanted = (await opened.prefetches()).map(({ url }) => url.replace(site.url, "").replace(/#.*/, ""));
  assert.deepEqual([...new Set(wanted)], expected);
  const made = () => [...new Set(site.requests.map(({ path }) => path))];
  await until("the requests", () => made().length >= expected.length);
  assert.deepEqual(made(), expected);
}

describe("the links that are loaded", () => {
  const site = hosted();

  it("are those that no rule excludes, each with its reason", async (t) => {
    const body = `
      <a id="plain" href="/a">a</a><a id="query" href="?page=2">a</a><a id="self" target="_self" href="/a">a</a>
      <a id="hash" href="#part">a</a><a id="empty" href="">a</a><a id="none">a</a><a id="mail" href="mailto:a@example.com">a</a>
      <a id="script" href="javascript:void 0">a</a><a id="broken" href="http://[">a</a><a id="other" href="https://example.com/">a</a>
      <a id="port" href="http://localhost:1/a">a</a><a id="docs" href="https://docs.example.org/a">a</a>
      <a id="download" download href="/a">a</a><a id="forced" download data-whither-prefetch="yes" href="/a">a</a>
      <a id="blank" target="_blank" href="/a">a</a><a id="frame" target="inner" href="/a">a</a>
      <a id="nofollow" rel="noopener NoFollow" href="/a">a</a><a id="external" rel="external" href="/a">a</a>
      <a id="noopener" rel="noopener" href="/a">a</a><a id="button" role="button" href="/a">a</a>
      <a id="rails" data-method="delete" href="/a">a</a><a id="turbo" data-turbo-method="post" href="/a">a</a>
      <a id="inline" onclick="return confirm('?')" href="/a">a</a><a id="pdf" href="/a.PDF">a</a><a id="page" href="/a.html?v=1.zip">a</a>
      <a id="logout" href="/logout">a</a><a id="cart" href="/?add-to-cart=3">a</a>
      <a id="allowed" data-whither-prefetch="yes" href="/cart/help">a</a>
      <div data-whither-prefetch="no"><a id="inside" href="/a">a</a><a id="within" data-whither-prefetch="yes" href="/a">a</a></div>
      <a id="pattern" href="/admin/a">a</a><a id="selected" class="slow" href="/a">a</a><a id="chosen" href="/a?n=7">a</a>
      <a id="overruled" data-whither-prefetch="yes" class="slow" href="/cart">a</a>
      <svg width="9" height="9"><a id="svg" href="/a"><rect width="9" height="9" /></a></svg><map><area id="area" href="/a"></map>`;
    const options = `ignore: [/\\/admin\\//g, ".slow", (url) => url.searchParams.get("n") === "7"], origins: ["https://docs.example.org"]`;
    const { page } = await open(t, site, body, { options });
    const reasons = () =>
      Object.fromEntries([...document.querySelectorAll("[id]")].map((link) => [link.id, ahead.excluded(link)]));
    const expected = {
      ...{
        plain: null,
        query: null,
        self: null,
        hash: "here",
        empty: "here",
        none: "address",
        mail: "address",
        script: "address",
      },
      ...{
        broken: "address",
        other: "origin",
        port: "origin",
        docs: null,
        download: "download",
        forced: "download",
        blank: "target",
      },
      ...{
        frame: "target",
        nofollow: "rel",
        external: "rel",
        noopener: null,
        button: "action",
        rails: "action",
        turbo: "action",
      },
      ...{ inline: "action", pdf: "file", page: null, logout: "unsafe", cart: "unsafe", allowed: null, inside: "attribute" },
      ...{ within: null, pattern: "ignore", selected: "ignore", chosen: "ignore", overruled: "ignore", svg: null, area: null },
    };
    for (let k = 0; k < 2; k++) assert.deepEqual(await page.evaluate(reasons), expected);
  });

  it("are no logout and no cart, however sure it is that they are meant", async (t) => {
    const opened = await open(t, site, linksTo("/logout", "/cart"), { options: "threshold: 0.5" });
    await asks(site, opened, "a:nth-of-type(1)", []);
    await asks(site, opened, "a:nth-of-type(2)", []);
  });

  it("are none where the user saves data", async (t) => {
    const init = () => Object.defineProperty(navigator, "connection", { value: { saveData: true, effectiveType: "4g" } });
    const opened = await open(t, site, linksTo("/a", "/b"), { init });
    await asks(site, opened, "a", []);
    assert.equal(await opened.page.evaluate(() => ahead.excluded(document.links[0])), "saveData");
    await opened.page.evaluate(() => (navigator.connection.saveData = false));
    await asks(site, opened, "a", ["/a"]);
  });

  it("are none on a connection that Chromium holds for slow, unless the page wants so", async (t) => {
    const slow = { offline: false, latency: 2000, downloadThroughput: 20_000, uploadThroughput: 20_000 };
    for (const options of ["", 'slowest: "slow-2g"']) {
      const opened = await open(t, site, linksTo("/a", "/b"), { options });
      const session = await opened.page.context().newCDPSession(opened.page);
      await session.send("Network.enable");
      await session.send("Network.emulateNetworkConditions", { ...slow, connectionType: "cellular2g" });
      assert.equal(await opened.page.evaluate(() => navigator.connection.effectiveType), "2g");
      await opened.reach("a", 1);
      const { requested } = await opened.stats();
      const excluded = await opened.page.evaluate(() => ahead.excluded(document.links[0]));
      assert.deepEqual([requested, excluded], options ? [1, null] : [0, "connection"]);
    }
  });

  it("are asked for once, however many links lead there", async (t) => {
    const opened = await open(t, site, linksTo("/a#one", "/a#two", "/a"), { options: "keep: 0" });
    for (const k of [1, 2, 3]) await asks(site, opened, `a:nth-of-type(${k})`, ["/a"]);
    assert.equal((await opened.stats()).requested, 1);
  });

  it("are asked for again once they are as old as the lifetime", async (t) => {
    const opened = await open(t, site, linksTo("/a", "/b"), { options: "keep: 0, lifetime: 0" });
    await asks(site, opened, "a", ["/a"]);
    const before = site.requests.length;
    await asks(site, opened, "a", ["/a"]);
    await until("another request", () => site.requests.length > before);
  });

  it("are asked for again on a page that comes back from the back/forward cache", async (t) => {
    const opened = await open(t, site, linksTo("/a", "/b"), { options: "keep: 0" });
    await asks(site, opened, "a", ["/a"]);
    await opened.page.evaluate(() => dispatchEvent(new PageTransitionEvent("pageshow", { persisted: true })));
    assert.equal(await opened.page.locator("[type=speculationrules]").count(), 0);
    await asks(site, opened, "a", ["/a"]);
    await until("another request", () => site.requests.length === 2);
  });

  it("are asked for even where the page's callbacks throw, which is reported", async (t) => {
    const options = 'onPrefetch() { throw new Error("mine") }, keep: 0';
    const opened = await open(t, site, linksTo("/a", "/b"), { options });
    await opened.reach("a", 1);
    await until("the request", () => site.requests.length > 0);
    await until("the report", () => opened.page.evaluate(() => errors.length > 0));
    assert.deepEqual(await opened.page.evaluate(() => errors), ["Error: mine"]);
    const broken = 'ignore: () => { throw new Error("broken") }';
    const other = await open(t, site, linksTo("/a", "/b"), { options: broken });
    await other.reach("a", 1);
    await until("the report", () => other.page.evaluate(() => errors.length > 0));
    assert.deepEqual(await other.page.evaluate(() => errors), ["Error: broken"]);
    assert.deepEqual(site.requests, []);
  });

  it("are as many as the limits allow", async (t) => {
    const total = await open(t, site, linksTo("/a", "/b", "/c"), { options: "keep: 0, limit: { total: 1 }" });
    await asks(site, total, "a:nth-of-type(1)", ["/a"]);
    await asks(site, total, "a:nth-of-type(2)", ["/a"]);
    const perMinute = await open(t, site, linksTo("/a", "/b", "/c"), { options: "keep: 0, limit: { perMinute: 0 }" });
    await asks(site, perMinute, "a:nth-of-type(1)", []);
    const running = await open(t, site, linksTo("/a", "/b", "/c"), { options: "limit: { running: 0 }" });
    await asks(site, running, "a:nth-of-type(1)", []);
  });

  it("are found when they come later, and in a shadow root", async (t) => {
    const body = '<div id="host"></div>';
    const first = `host.attachShadow({ mode: "open" }).innerHTML = "<nav></nav>";`;
    const opened = await open(t, site, body, { first, options: "root: host.shadowRoot" });
    await opened.page.evaluate((html) => (host.shadowRoot.firstChild.innerHTML = html), linksTo("/later", "/b"));
    await asks(site, opened, "a", ["/later"]);
    assert.equal(await opened.page.evaluate(() => prefetches[0].url), `${site.url}/later`);
  });

  it("are those of the selector alone", async (t) => {
    const body = linksTo("/a", '<a class="yes" href="/b">Link</a>');
    const opened = await open(t, site, body, { options: 'selector: "a.yes"' });
    await opened.reach("a:nth-of-type(1)", 1);
    await asks(site, opened, "a:nth-of-type(2)", ["/b"]);
    assert.equal(await opened.page.evaluate(() => ahead.watcher.targets.length), 1);
  });
});

describe("the ways in which they are loaded", () => {
  const site = hosted();
  const POLICY = "script-src 'nonce-abc' 'wasm-unsafe-eval' 'self'";

  it("rules have the page's nonce, a tag and the link's referrer policy", async (t) => {
    const body = linksTo('<a referrerpolicy="no-referrer" href="/a">Link</a>', "/b");
    const options = 'tag: "whither", noVarySearch: \'params=("utm")\'';
    const headers = { "content-security-policy": POLICY };
    const opened = await open(t, site, body, { options, headers, nonce: "abc" });
    await asks(site, opened, "a", ["/a"]);
    assert.equal(site.requests[0].tags, '"whither"');
    const [rule] = await opened.page.evaluate(() => JSON.parse(document.querySelector("[type=speculationrules]").text).prefetch);
    assert.deepEqual(rule, {
      source: "list",
      urls: [`${site.url}/a`],
      referrer_policy: "no-referrer",
      tag: "whither",
      expects_no_vary_search: 'params=("utm")',
    });
  });

  for (const [what, policy] of [
    ["a policy without their nonce", POLICY],
    ["Trusted Types", "require-trusted-types-for 'script'"],
  ]) {
    it(`the next mechanism is taken where ${what} refuses rules`, async (t) => {
      const headers = { "content-security-policy": policy };
      const options = what === "Trusted Types" ? "" : 'nonce: "wrong"';
      const opened = await open(t, site, linksTo("/a", "/b"), { options, headers, nonce: "abc" });
      await opened.reach("a", 1);
      await until("the request", () => site.requests.length > 0);
      assert.equal(site.requests[0].dest, "empty");
      const [first, ...others] = (await opened.prefetches()).map(({ mechanism }) => mechanism);
      assert.deepEqual([first, ...new Set(others)], ["rules", "link"]);
      assert.equal((await opened.stats()).requested, others.length);
      await opened.reach("a:nth-of-type(2)", 1);
      await until("the other request", () => site.requests.some(({ path }) => path === "/b"));
      assert.equal((await opened.prefetches()).at(-1).mechanism, "link");
      assert.deepEqual(await opened.page.evaluate(() => errors), []);
    });
  }

  it("a link's rule is no use in a frame, so the next mechanism is taken", async (t) => {
    const { page } = await open(
      t,
      site,
      '<iframe id="inner" srcdoc="<a href=/a style=font-size:40px>A</a>" width="900" height="300"></iframe>',
      {
        options: "root: inner.contentDocument",
        first:
          "await new Promise((resolve) => (inner.contentDocument.readyState === 'complete' ? resolve() : (inner.onload = resolve)));",
      },
    );
    await page.frameLocator("iframe").locator("a").focus();
    await until("the request", () => site.requests.length === 1);
    assert.equal(site.requests[0].dest, "empty");
  });

  for (const [mechanism, init] of [
    ["link", () => (HTMLScriptElement.supports = () => false)],
    ["fetch", () => ((HTMLScriptElement.supports = () => false), (DOMTokenList.prototype.supports = () => false))],
  ]) {
    it(`${mechanism} reports what failed, and asks again`, async (t) => {
      const opened = await open(t, site, linksTo("/a?status=404", "/b"), { init, options: "reasons: { pointer: true }" });
      await opened.reach("a", 1);
      await until("the error", () => opened.page.evaluate(() => errors.length > 0));
      const [error] = await opened.page.evaluate(() => errors);
      assert.match(error, /^Error: cannot load http:\/\/localhost:\d+\/a\?status=404/);
      const { requested, failed } = await opened.stats();
      assert.equal(requested, failed);
      await opened.reach("a", 1);
      await until("the next failure", async () => (await opened.stats()).failed > failed);
    });
  }

  it("failures are counted and nothing more where nobody asks", async (t) => {
    const opened = await open(t, site, linksTo("/a?status=500", "/b"), { options: 'mechanism: "fetch", onError: undefined' });
    await opened.reach("a", 1);
    await until("the failure", async () => (await opened.stats()).failed > 0);
  });

  for (const mechanism of ["rules", "link", "fetch"]) {
    it(`${mechanism} asks another origin where that is named`, async (t) => {
      const first = 'const other = location.origin.replace("localhost", "127.0.0.1"); document.links[0].href = other + "/there";';
      const options = `mechanism: "${mechanism}", origins: [other]`;
      const opened = await open(t, site, linksTo("/a", "/b"), { first, options });
      await opened.reach("a", 1);
      await until("the request", () => site.requests.length > 0);
      assert.equal(site.requests[0].path, "/there");
      assert.deepEqual(await opened.page.evaluate(() => errors), []);
    });
  }

  it("a function of the page's own loads, and its signal aborts", async (t) => {
    const first = "window.loads = [];";
    const options = `mechanism: ({ url, mechanism, signal }) => new Promise((resolve) => loads.push({ url, mechanism, signal, resolve }))`;
    const opened = await open(t, site, linksTo("/a#x", "/b"), { first, options });
    const to = await opened.reach("a", 1);
    await until("the request", async () => (await opened.stats()).running === 1);
    await opened.turnAway(to);
    const [{ aborted, ...given }] = await opened.page.evaluate(() =>
      loads.map((load) => ({ ...load, aborted: load.signal.aborted })),
    );
    assert.deepEqual([given.url, given.mechanism, aborted], [`${site.url}/a#x`, "own", true]);
    const { requested, cancelled } = await opened.stats();
    assert.equal(requested, cancelled);
    await opened.reach("a", 1);
    await until("the next request", async () => (await opened.stats()).running === 1);
    await opened.page.evaluate(() => loads.at(-1).resolve());
    await opened.turnAway(to);
    assert.equal((await opened.stats()).wasted, 1);
    assert.deepEqual(site.requests, []);
  });

  it("a prerendering rule comes on top above its own threshold, and goes when the pointer turns away", async (t) => {
    const rules = (page) =>
      page.evaluate(() =>
        [...document.querySelectorAll("[type=speculationrules]")].flatMap(({ text }) => Object.keys(JSON.parse(text))),
      );
    const off = await open(t, site, linksTo("/a", "/b"), { options: "keep: 0" });
    await off.reach("a", 1);
    assert.deepEqual(await rules(off.page), ["prefetch"]);
    const on = await open(t, site, linksTo("/a", "/b"), { options: "keep: 0, threshold: 0.6, prerender: { threshold: 0.9 }" });
    await on.turnAway(await on.reach("a", 1));
    assert.deepEqual(await rules(on.page), ["prefetch"]);
    assert.ok((await on.stats()).prerendered > 0);
    await on.reach("a", 1);
    assert.deepEqual(await rules(on.page), ["prefetch", "prerender"]);
    assert.equal(site.requests.length, 1, "what was fetched is what would be prerendered");
  });
});

describe("what is left of links", () => {
  const site = hosted();

  for (const [how, stop] of [
    ["stop()", () => ahead.stop()],
    ["its signal", () => controller.abort()],
    ["using", () => ahead[Symbol.dispose]()],
  ]) {
    it(`nothing after ${how}`, async (t) => {
      const first = "window.controller = new AbortController();";
      const options = "keep: 0, signal: controller.signal, prerender: { threshold: 0.5 }";
      const opened = await open(t, site, linksTo("/a", "/b?wait=60000"), { first, options });
      await opened.reach("a");
      assert.ok((await opened.page.locator("[type=speculationrules]").count()) > 0);
      await opened.page.evaluate(stop);
      assert.equal(await opened.page.locator("[type=speculationrules], [rel=prefetch], [data-predicted]").count(), 0);
      const ahead = () => site.requests.filter(({ purpose }) => purpose).length;
      const [before, { running }] = [ahead(), await opened.stats()];
      await opened.hand.press(await opened.reach("a:nth-of-type(2)"));
      assert.equal(ahead(), before);
      assert.equal(running, 0);
    });
  }

  it("what is wrong with an option is an error with its path, and nothing is watched", async (t) => {
    const { page } = await open(t, site, linksTo("/a"));
    const report = (given) =>
      page.evaluate((text) => {
        try {
          links(new Function(`return ${text}`)());
          return null;
        } catch ({ name, code, path, message }) {
          return [name, code, path, message].join(" | ");
        }
      }, given);
    const expected = {
      "{ ignor: 1 }":
        /^WhitherError \| unknown-key \| ignor \| ignor: unknown key "ignor", expected one of "selector", "ignore", .*"threshold"/,
      "{ onIntent() {} }": /unknown-key \| onIntent/,
      "[]": /wrong-type \| {2}\| must be an object|wrong-type \| options/,
      '{ selector: "a[" }': /out-of-range \| selector \| .*must be a selector, got "a\["/,
      '{ ignore: ["a["] }': /out-of-range \| ignore\[0\] \| .*must be a selector/,
      "{ ignore: 3 }": /wrong-type \| ignore \| .*must be a regular expression, a selector or a function, got 3/,
      '{ unsafe: "logout" }': /wrong-type \| unsafe \| .*must be a regular expression or null, got "logout"/,
      '{ origins: ["https://example.com/a"] }': /out-of-range \| origins\[0\] \| .*must be an origin such as/,
      '{ origins: "*" }': /wrong-type \| origins \| .*must be a list/,
      '{ slowest: "5g" }': /out-of-range \| slowest \| .*must be one of slow-2g, 2g, 3g, 4g, got "5g"/,
      "{ limit: { running: -1 } }": /out-of-range \| limit\.running \| .*must be at least 0, got -1/,
      "{ limit: { most: 1 } }": /unknown-key \| limit\.most/,
      '{ mechanism: "own" }': /out-of-range \| mechanism \| .*must be one of rules, link, fetch, got "own"/,
      "{ prerender: { threshold: 2 } }": /out-of-range \| prerender\.threshold \| .*must be greater than 0 and at most 1, got 2/,
      '{ prerender: "yes" }': /wrong-type \| prerender \| .*must be an object/,
      "{ keep: NaN }": /not-finite \| keep/,
      "{ nonce: 3 }": /wrong-type \| nonce \| .*must be a string, got 3/,
      "{ onPrefetch: 3 }": /wrong-type \| onPrefetch \| .*must be a function, got 3/,
      "{ threshold: 3 }": /out-of-range \| threshold/,
    };
    for (const [given, pattern] of Object.entries(expected)) assert.match(await report(given), pattern, given);
    const legal =
      "{ unsafe: null, prerender: false, ignore: undefined, limit: {}, root: document, origins: ['*'], mechanism: 'fetch' }";
    assert.equal(await report(legal), null);
  });
});
