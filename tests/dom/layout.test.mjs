// Where targets are: whatever moves them on the page, what the pointer goes to is predicted where it is now.
import { describe, it } from "node:test";
import { aim, hosted, open, RIVALS, STALE, STYLE } from "./aim.mjs";

/** A target in `#moved`, which moves or changes it. */
const inside = (left, top, style = "") =>
  `${RIVALS}<div id="moved" class="place" style="left: 0; top: 0"><button class="target place" id="target"
    style="left: ${left}px; top: ${top}px; ${style}"></button></div>`;

/** A target below what grows by 200 px. */
const below = (grows) =>
  `${RIVALS}${grows}<button class="target" id="target" style="display: block; margin-left: 670px"></button>`;

/** A page that fills its window and has a target this far from its left and top. */
const wide = (left, top, style = "") =>
  `<div class="place" style="width: 3000px; height: 3000px; ${style}"><button class="target place" id="target"
    style="left: ${left}px; top: ${top}px"></button></div>`;

/** Runs on the page. */
const on = (expression) => (page) => page.evaluate(expression);

/** Adds a rule that nothing in the tree shows. */
const rule = (text) => on(`document.styleSheets[0].insertRule(${JSON.stringify(text)})`);

/** The mistake of moving every target by as much. */
const shifted = (dx, dy) => (before) => before.map((box) => ({ ...box, x: box.x + dx, y: box.y + dy }));

/** Something whose answer comes later than the page. */
const late = (name, contentType, body) => async (page) => {
  await page.route(`**/${name}`, async (route) => {
    await new Promise((resolve) => setTimeout(resolve, 80));
    await route.fulfill({ contentType, body });
  });
};

const cases = {
  "the page scrolls": { body: RIVALS + wide(670, 1120), change: on("scrollTo(0, 800)"), early: true },
  "the page scrolls sideways": { body: RIVALS + wide(1470, 320), change: on("scrollTo(800, 0)") },
  "a page from right to left scrolls sideways": {
    body: `${RIVALS}<div style="position: relative; width: 3000px; height: 500px"><button class="target place" id="target"
      style="right: 1070px; top: 320px"></button></div><script>document.documentElement.dir = "rtl"</script>`,
    change: on("scrollTo(-800, 0)"),
  },
  "containers scroll in one another": {
    body: `${RIVALS}<div id="outer" class="place" style="left: 550px; top: 200px; width: 350px; height: 400px; overflow: auto">
      <div style="height: 1500px; padding-top: 500px"><div id="inner" style="position: relative; margin-left: 20px; width: 300px;
      height: 300px; overflow: auto"><div style="height: 1000px"><button class="target place" id="target"
      style="left: 100px; top: 600px"></button></div></div></div></div>`,
    change: on("outer.scrollTop = 400; inner.scrollTop = 580"),
  },
  "the target is fixed and the page scrolls": {
    body: `<button class="target" id="target" style="position: fixed; left: 670px; top: 320px"></button>
      <div class="place" style="width: 100px; height: 3000px"><button class="target place" id="rival-0" style="left: 670px; top: 970px"></button>
      <button class="target place" id="rival-1" style="left: 820px; top: 1120px"></button></div>`,
    change: on("scrollTo(0, 800)"),
    mistakes: [shifted(0, -800)],
  },
  "the target is sticky and the page scrolls": {
    body: `${RIVALS}<div style="height: 600px"></div>
      <button class="target" id="target" style="display: block; position: sticky; margin-left: 670px; top: 320px"></button>
      <div style="height: 3000px"></div>`,
    change: on("scrollTo(0, 700)"),
  },
  "an ancestor is translated": {
    body: inside(170, 120),
    change: on('moved.style.transform = "translate(500px, 200px)"'),
    early: true,
  },
  "an ancestor is scaled": {
    body: inside(335, 160, "width: 30px; height: 30px"),
    change: on('moved.style.cssText += "transform-origin: 0 0; transform: scale(2)"'),
  },
  "an ancestor is rotated": {
    body: inside(270, 20),
    change: on('moved.style.cssText += "transform-origin: 500px 200px; transform: rotate(180deg)"'),
  },
  "a transition runs on an ancestor": {
    body: inside(170, 120),
    // there at once, and 20 s more in which it hardly moves
    head: "<style>#moved { transition: transform 20s linear(0, 1 1%, 1.01) }</style>",
    change: on('moved.style.transform = "translate(500px, 200px)"'),
  },
  "an animation runs on an ancestor": {
    body: inside(170, 120),
    head: "<style>@keyframes go { 1%, 100% { transform: translate(500px, 200px) } } .going { animation: go 20s }</style>",
    change: on('moved.className += " going"'),
  },
  "a script animates an ancestor, with nothing in the tree to show it": {
    body: inside(170, 120),
    change: on(`moved.animate([{}, { transform: "translate(500px, 200px)", offset: 0.01 },
      { transform: "translate(502px, 200px)" }], 20000) && undefined`),
  },
  "a script moves an ancestor in each frame": {
    body: inside(170, 120),
    change: on(`(function step(time) {
      moved.style.transform = "translate(" + (500 + 5 * Math.sin(time / 100)) + "px, 200px)";
      requestAnimationFrame(step);
    })(0)`),
  },
  "the page is zoomed": {
    body: `${inside(335, 160, "width: 30px; height: 30px").replace(RIVALS, "")}
      <button class="target place" id="rival-0" style="left: 335px; top: 85px; width: 30px; height: 30px"></button>
      <button class="target place" id="rival-1" style="left: 670px; top: 320px"></button>`,
    change: on("document.body.style.zoom = 2"),
  },
  "something in the page is zoomed": {
    body: inside(335, 160, "width: 30px; height: 30px"),
    change: on("moved.style.zoom = 2"),
    early: true,
  },
  "the target goes to another parent": {
    body: `${inside(170, 120)}<div class="place" id="other" style="left: 500px; top: 200px"></div>`,
    change: on("other.append(target)"),
  },
  "the window gets wider": {
    body: `${RIVALS}<button class="target" id="target" style="position: fixed; right: 470px; top: 320px"></button>`,
    change: (page) => page.setViewportSize({ width: 1200, height: 700 }),
  },
  "an image gets its size": {
    body: below('<img id="image" style="display: block; margin-bottom: 120px">'),
    prepare: late("late.svg", "image/svg+xml", '<svg xmlns="http://www.w3.org/2000/svg" width="20" height="200"/>'),
    change: on('image.src = "late.svg"; image.decode()'),
  },
  "a <details> opens": {
    body: below(
      '<details id="more" style="margin-bottom: 100px"><summary style="height: 20px">More</summary><p style="margin: 0; height: 200px"></p></details>',
    ),
    change: on("more.open = true"),
    early: true,
  },
  "what the pointer is over grows": {
    body: `<div class="place" id="stage" style="left: 150px; top: 0; width: 850px; height: 700px">${RIVALS}
      <button class="target place" id="target" style="left: 520px; top: 120px"></button></div>`,
    head: "<style>#stage:hover > #target { margin-top: 200px }</style>",
    change: () => {},
  },
  "a style sheet arrives": {
    body: inside(170, 120),
    prepare: late("late.css", "text/css", "#target { margin: 200px 0 0 500px }"),
    change: on(`document.head.insertAdjacentHTML("beforeend", '<link rel="stylesheet" href="late.css">')`),
  },
  "a <style> is added": {
    body: inside(170, 120),
    change: on('document.head.insertAdjacentHTML("beforeend", "<style>#target { margin: 200px 0 0 500px }</style>")'),
  },
  "a rule is added to a style sheet": { body: inside(170, 120), change: rule("#target { margin: 200px 0 0 500px }") },
  "a rule is added while the pointer rests": {
    body: inside(170, 120),
    change: rule("#target { margin: 200px 0 0 500px }"),
    early: true,
  },
  "a constructed style sheet is adopted": {
    body: inside(170, 120),
    change: on(`const sheet = new CSSStyleSheet();
      sheet.replaceSync("#target { margin: 200px 0 0 500px }");
      document.adoptedStyleSheets.push(sheet)`),
  },
  "the font gets larger": {
    body: below('<div style="height: 10rem; margin-bottom: 0"></div>'),
    change: on('document.documentElement.style.fontSize = "32px"'),
  },
  "text before it gets longer": {
    body: below('<p id="text" style="margin: 0 0 100px; font: 20px/20px monospace; white-space: pre">a line</p>'),
    change: on('text.firstChild.data += "\\nand another".repeat(10)'),
  },
  "what came before it is removed": {
    body: `${inside(170, 120)}<i id="before"></i>`,
    head: "<style>body:not(:has(#before)) #target { margin: 200px 0 0 500px }</style>",
    change: on("before.remove()"),
  },
  "a virtual target is moved": {
    body: `${RIVALS}<canvas id="target" class="place" style="left: 0; top: 0" width="1000" height="700"></canvas>`,
    first: "window.shape = { id: 'target', place: { x: 170, y: 120, width: 60, height: 60 }, bounds: () => shape.place };",
    watched: '[shape, ...document.querySelectorAll(".target")]',
    change: on("shape.place = { x: 670, y: 320, width: 60, height: 60 }"),
  },
};

/** A host with an open shadow root in which this is. */
const shadow = (id, content) => `<div id="${id}"><template shadowrootmode="open">${STYLE}${content}</template></div>`;

const inShadow = {
  "a selector looks in a shadow root": {
    body: shadow("host", inside(170, 120)),
    options: "{ root: host.shadowRoot }",
    change: on('host.shadowRoot.getElementById("moved").style.transform = "translate(500px, 200px)"'),
  },
  "targets are in and out of nested shadow roots": {
    body: RIVALS + shadow("host", shadow("within", inside(170, 120).replace(RIVALS, ""))),
    first: 'const root = host.shadowRoot.getElementById("within").shadowRoot;',
    watched: '[...document.querySelectorAll(".target"), root.getElementById("target")]',
    change: on(`const root = host.shadowRoot.getElementById("within").shadowRoot;
      root.styleSheets[0].insertRule("#moved { translate: 500px 200px }")`),
  },
};

/** An iframe with this page in it. */
const frame = (style, page = "inner.html") => `<iframe src="${page}" class="place" style="border: 0; ${style}"></iframe>`;

/** A page of its own for an iframe. */
const content = (left, top, more = "") => `<!doctype html><style>body { margin: 0 }</style>${STYLE}${more}
  <button class="target place" id="target" style="left: ${left}px; top: ${top}px"></button>`;

const frames = {
  first: `const loaded = async (page) => {
      const frame = page.querySelector("iframe");
      const blank = frame.contentDocument.URL === "about:blank" || frame.contentDocument.readyState !== "complete";
      if (blank) await new Promise((resolve) => frame.addEventListener("load", resolve));
      return frame.contentDocument;
    };
    window.inner = await loaded(document);`,
  watched: '[...document.querySelectorAll(".target"), ...inner.querySelectorAll(".target")]',
};

const inFrames = {
  "an iframe with border and padding is moved": {
    ...frames,
    body: RIVALS + frame("left: 150px; top: 60px; width: 500px; height: 400px; border: 20px solid; padding: 30px"),
    pages: { "inner.html": content(320, 70) },
    change: on('document.querySelector("iframe").style.cssText += "left: 300px; top: 200px"'),
    mistakes: [STALE, (_, now) => now.map((box) => (box.id === "target" ? { ...box, x: 350, y: 100 } : box))],
  },
  "an iframe is scaled": {
    ...frames,
    body: RIVALS + frame("left: 300px; top: 150px; width: 300px; height: 250px; border: 5px solid; transform-origin: 0 0"),
    pages: { "inner.html": content(180, 80).replace("top:", "width: 30px; height: 30px; top:") },
    change: on('document.querySelector("iframe").style.transform = "scale(2)"'),
  },
  "an iframe is scrolled inside": {
    ...frames,
    body: RIVALS + frame("left: 300px; top: 100px; width: 500px; height: 500px"),
    pages: { "inner.html": content(370, 620, '<div style="height: 3000px">') },
    change: on("inner.defaultView.scrollTo(0, 400)"),
  },
  "an iframe's page changes": {
    ...frames,
    body: RIVALS + frame("left: 300px; top: 100px; width: 500px; height: 500px"),
    pages: { "inner.html": content(100, 20) },
    change: on('inner.styleSheets[0].insertRule("#target { margin: 200px 0 0 270px }")'),
  },
  "the pointer leaves an iframe for a target of the page": {
    ...frames,
    body: frame("left: 0; top: 0; width: 400px; height: 700px") + inside(170, 120),
    pages: { "inner.html": content(100, 20).replace("target place", "target").replace('id="target"', 'id="rival-2"') },
    change: on('moved.style.transform = "translate(500px, 200px)"'),
  },
  "a selector looks in an iframe's document": {
    ...frames,
    body: frame("left: 0; top: 0; width: 980px; height: 680px; border: 10px solid"),
    pages: { "inner.html": content(160, 110, RIVALS) },
    watched: '".target"',
    options: "{ root: inner }",
    change: on('inner.getElementById("target").style.translate = "500px 200px"'),
  },
  "an iframe is in an iframe": {
    ...frames,
    first: `${frames.first} window.innermost = await loaded(inner);`,
    watched: '[...document.querySelectorAll(".target"), ...innermost.querySelectorAll(".target")]',
    body: RIVALS + frame("left: 100px; top: 50px; width: 800px; height: 600px; border: 10px solid"),
    pages: {
      "inner.html": `<!doctype html><style>body { margin: 0 }</style>${STYLE}
        ${frame("left: 90px; top: 40px; width: 600px; height: 500px; border: 10px solid", "innermost.html")}`,
      "innermost.html": content(160, 10),
    },
    change: on('innermost.getElementById("target").style.translate = "300px 200px"'),
  },
};

describe("layout", () => {
  const site = hosted();

  for (const [name, { body, change, prepare, early, mistakes, ...options }] of Object.entries({
    ...cases,
    ...inShadow,
    ...inFrames,
  })) {
    it(name, async () => {
      const { page, close } = await open(site, body, options);
      await prepare?.(page);
      await aim(page, change, { early, mistakes });
      await close();
    });
  }

  it("the page is enlarged with two fingers", async () => {
    // beside the goal by as much as the window then begins further to the right and down
    const rival = '<button class="target place" id="rival-2" style="left: 727px; top: 458px"></button>';
    const { page, close } = await open(site, `${inside(670, 320)}${rival}`);
    const view = { x: 0, y: 0 };
    const pinch = async () => {
      const session = await page.context().newCDPSession(page);
      await session.send("Input.synthesizePinchGesture", { x: 250, y: 600, scaleFactor: 1.3 });
      Object.assign(view, await page.evaluate("({ x: visualViewport.offsetLeft, y: visualViewport.offsetTop })"));
    };
    const map = ({ x, y }) => ({ x: x - view.x, y: y - view.y });
    // the browser's inspector counts from the corner of what is visible, and events do not
    await aim(page, pinch, { early: true, map, mistakes: [(_, now) => now] });
    await close();
  });
});
