// The declarations of whither/react for strict users of React 18 and 19, by the oldest TypeScript and this one.
import assert from "node:assert/strict";
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { capture, root } from "../../scripts/run.mjs";
import { folder } from "./support.mjs";

const program = `
import { type ChangeEvent, Component, createRef, forwardRef, useEffect, useRef, type ReactNode, type Ref } from "react";
import { Intent, IntentProvider, useIntent, useIntentRef, useMergedRefs, usePrediction, useWatcher } from "whither/react";
import type { IntentOptions, IntentProps, IntentState } from "whither/react";
import type { VirtualTarget } from "whither/dom";

export function Port({ id, name }: { id: string; name: string }) {
  const { ref, intended }: IntentState<HTMLAnchorElement> = useIntent<HTMLAnchorElement>({
    hitSlop: { top: 4 },
    onIntent: async ({ target, signal }) => fetch(target.href, { signal }),
    onRelease: ({ target, pressed }) => target.classList.toggle("pressed", pressed),
  });
  return <a ref={ref} href={\`/ports/\${id}\`} className={intended ? "next" : ""}>{name}</a>;
}

// an element's own type is Element where nothing else is stated, and its ref suits every element
export function Any() {
  const { ref } = useIntent({ onIntent: ({ target }) => target.setAttribute("data-on", "") });
  return <><button ref={ref} /><svg ref={ref} /></>;
}

interface CardProps {
  title: string;
  children?: ReactNode;
}
export const Card = forwardRef<HTMLElement, CardProps>(function Card({ title, children }, forwarded) {
  const own = useRef<HTMLElement>(null);
  const ref = useMergedRefs(own, forwarded, useIntentRef({ enabled: true }));
  useEffect(() => own.current?.focus(), []);
  return <article ref={ref} title={title}>{children}</article>;
});
class Thing extends Component<{ size: number }> {
  override render() {
    return null;
  }
}
const button = createRef<HTMLButtonElement>();
const link: Ref<HTMLAnchorElement> = (node) => node?.focus();

export const all = (options: IntentOptions, props: IntentProps<"button">) => (
  <IntentProvider threshold={0.9} limit={{ running: 2 }} onIntent={({ target, data }) => console.log(target.id, data)}>
    <Intent ref={link} href="/ports" onIntent={({ signal }) => signal.aborted}>Ports</Intent>
    <Intent as="button" ref={button} type="submit" disabled intent={{ hitSlop: 8, prior: 2 }} />
    <Intent as={Card} title="A card" onRelease={({ pressed }) => console.log(pressed)}>In it</Intent>
    <Intent as={Thing} size={2} intent={options} />
    <Intent {...props} as="button" />
    <Intent as="input" value="3" onChange={(event: ChangeEvent<HTMLInputElement>) => event.currentTarget.value} />
  </IntentProvider>
);

export function Early({ shapes }: { shapes: VirtualTarget[] }) {
  const watcher = useWatcher<Element | VirtualTarget>();
  const best: string | undefined = usePrediction(({ best }) => best?.target.id);
  const count: number = usePrediction(({ targets }) => targets.length);
  useEffect(() => {
    watcher?.add(...shapes);
    return () => watcher?.remove(...shapes);
  }, [watcher, shapes]);
  return <p title={best}>{count} {watcher?.ledger.summary()?.lead}</p>;
}

// @ts-expect-error: there is no such option
useIntent({ treshold: 0.8 });
// @ts-expect-error: a button has no address
<Intent as="button" href="/ports" />;
// @ts-expect-error: a card has a title
<Intent as={Card} />;
// @ts-expect-error: the watcher has the elements of its components
<IntentProvider target={{ hitSlop: 8 }} />;
// @ts-expect-error: what is called is a prop of its own
<Intent intent={{ onIntent: () => {} }} />;
`;

const cases = { 18: ["the oldest TypeScript", "typescript-floor"], 19: ["this TypeScript", "typescript"] };

for (const [version, [by, compiler]] of Object.entries(cases)) {
  test(`the declarations compile with React ${version}, by ${by}`, async () => {
    const project = join(folder, `types-${version}`);
    const types = `../node_modules/@types/react-${version}`;
    const ours = (name) => [join(root, `dist/types/${name}.d.ts`)];
    const compilerOptions = {
      strict: true,
      exactOptionalPropertyTypes: true,
      skipLibCheck: false,
      noEmit: true,
      target: "ES2022",
      lib: ["ES2022", "DOM", "DOM.Iterable"],
      module: "esnext",
      moduleResolution: "bundler",
      jsx: "react-jsx",
      types: [],
      noImplicitOverride: true,
      paths: {
        react: [`${types}/index.d.ts`],
        "react/jsx-runtime": [`${types}/jsx-runtime.d.ts`],
        "whither/react": ours("react"),
        "whither/dom": ours("dom"),
      },
    };
    mkdirSync(project, { recursive: true });
    writeFileSync(join(project, "use.tsx"), program);
    writeFileSync(join(project, "tsconfig.json"), JSON.stringify({ compilerOptions, files: ["use.tsx"] }));
    const { code, output } = await capture("node", [join(root, "node_modules", compiler, "bin/tsc")], { cwd: project });
    assert.equal(code, 0, output);
  });
}
