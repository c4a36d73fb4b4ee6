import { init, PointerPredictor } from "whither/pointing";

await init();
export function rightAfter({ targets, target, samples }) {
  const boxes = targets.map(([x, y, width, height], id) => ({ id: `${id}`, x, y, width, height }));
  const predictor = new PointerPredictor(boxes);
  return samples.map(([time, x, y]) => {
    predictor.observe(time, [x, y]);
    return predictor.best?.index === target;
  });
}
