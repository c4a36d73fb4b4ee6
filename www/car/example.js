import { watch } from "whither/dom";

watch("button", {
  onIntent: ({ target, signal }) => {
    target.classList.add("lit");
    signal.onabort = () => target.classList.remove("lit");
  },
  onPrediction: ({ best }) => console.log(best),
  onOutcome: ({ verdict, lead }) => console.log(verdict, lead),
});
