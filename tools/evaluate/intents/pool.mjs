// Workers that replay beside one another, each with the same page and options.
import { availableParallelism } from "node:os";
import { Worker } from "node:worker_threads";

export class Pool {
  #workers;

  /** `page` is the address of js/dom/testing's page, bundled; each of the options is given to a watcher of its own. */
  constructor(page, options) {
    const workerData = { page, options };
    const file = new URL("worker.mjs", import.meta.url);
    this.#workers = Array.from({ length: availableParallelism() }, () => new Worker(file, { workerData }));
  }

  /** Has jobs done, and answers in their order, however many worked on them; `label` of them is printed at every tenth. */
  async run(jobs, label) {
    const answers = new Array(jobs.length);
    let next = 0;
    let done = 0;
    const work = async (worker) => {
      while (next < jobs.length) {
        const mine = next++;
        answers[mine] = await ask(worker, jobs[mine]);
        done++;
        const tenth = Math.floor((10 * done) / jobs.length);
        if (tenth > Math.floor((10 * (done - 1)) / jobs.length)) console.error(`${10 * tenth}% of ${label}`);
      }
    };
    await Promise.all(this.#workers.map(work));
    return answers;
  }

  async stop() {
    for (const worker of this.#workers) await worker.terminate();
  }
}

function ask(worker, job) {
  return new Promise((resolve, reject) => {
    worker.once("error", reject);
    worker.once("message", (answer) => {
      worker.off("error", reject);
      resolve(answer);
    });
    worker.postMessage(job);
  });
}
