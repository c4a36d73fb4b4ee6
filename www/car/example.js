import { init, pointerScenario, Predictor } from "whither";
await init();
const targets = [...document.querySelectorAll("button")].map((icon) => {
  const { x, y, width, height } = icon.getBoundingClientRect();
  return { id: icon.id, x: x + width / 2, y: y + height / 2, width, height };
});
const predictor = new Predictor(pointerScenario(targets));
onpointermove = ({ timeStamp, clientX, clientY }) =>
  predictor.observe(timeStamp / 1000, [clientX, clientY]);
setInterval(() => console.log(predictor.best), 100);
