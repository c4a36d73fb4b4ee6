/** The papers that the page cites. */

interface Paper {
  readonly title: string;
  readonly source: string;
  readonly address: string;
}

const PAPERS: readonly Paper[] = [
  {
    title: "Efficient bridging-based destination inference in object tracking",
    source: "T. Ardeshiri, B. I. Ahmad, P. M. Langdon, S. J. Godsill. ICASSP, 2017",
    address: search("Efficient bridging-based destination inference in object tracking"),
  },
  {
    title: "On destination prediction based on Markov bridging distributions",
    source: "J. Liang, B. I. Ahmad, R. Gan, P. Langdon, R. Hardy, S. Godsill. IEEE Signal Processing Letters, 2019",
    address: search("On destination prediction based on Markov bridging distributions"),
  },
  {
    title: "Destination-directed trajectory modeling and prediction using conditionally Markov sequences",
    source: "R. Rezaie, X. R. Li. IEEE, 2018; arXiv 1811.08021",
    address: "https://arxiv.org/abs/1811.08021",
  },
];

export function listPapers(list: HTMLElement): void {
  list.append(...PAPERS.map(entry));
}

function entry(paper: Paper): HTMLLIElement {
  const item = document.createElement("li");
  const link = document.createElement("a");
  link.href = paper.address;
  link.textContent = paper.title;
  const source = document.createElement("span");
  source.textContent = paper.source;
  item.append(link, source);
  return item;
}

/** The registry of DOIs finds a paper by its title. */
function search(title: string): string {
  return `https://search.crossref.org/?${new URLSearchParams({ q: title }).toString()}`;
}
