import { createSignal, For } from "solid-js";
import { intent } from "./intent.js";

export function App() {
  const [ports, setPorts] = createSignal(["Cowes", "Ryde", "Yarmouth"]);
  const [next, setNext] = createSignal("none");
  return (
    <>
      <nav>
        <For each={ports()}>
          {(port) => (
            <a href={`#${port}`} ref={intent({ onIntent: () => setNext(port), onRelease: () => setNext("none") })}>
              {port}
            </a>
          )}
        </For>
      </nav>
      <button onClick={() => setPorts(["Bembridge", "Cowes"])}>Others</button>
      <output>{next()}</output>
    </>
  );
}
