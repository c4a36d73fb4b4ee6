/**
 * The panel's styles. They are adopted by the shadow root, which a Content-Security-Policy for styles does not forbid; what the page
 * has for every element is without effect in it.
 *
 * @module
 */

const LIGHT = `color-scheme: light; --ground: #fffdf9; --raised: #f4efe6; --line: #ddd4c4; --text: #211d16; --muted: #665d4e;
  --light: #9a5200; --ink: #fff; --quiet: #6b6459; --track: #e8e1d4; --bad: #b3261e; --good: #1b6e3c;`;

const DARK = `color-scheme: dark; --ground: #11161e; --raised: #1a212c; --line: #2a3443; --text: #e9ecf1; --muted: #9da8b9;
  --light: #ffb44a; --ink: #201200; --quiet: #98a3b4; --track: #283140; --bad: #ff8a80; --good: #6fd59a;`;

export const STYLES = `
:host {
  all: initial !important; position: fixed !important; inset: 0 !important; z-index: 2147483647 !important; display: block !important;
  width: auto !important; height: auto !important; margin: 0 !important; padding: 0 !important; border: 0 !important;
  overflow: hidden !important; background: none !important; pointer-events: none !important; contain: strict;
}
.root { ${LIGHT} }
.root[data-theme="dark"] { ${DARK} }
@media (prefers-color-scheme: dark) { .root[data-theme="auto"] { ${DARK} } }
[hidden] { display: none !important; }
*, ::before, ::after { box-sizing: border-box; }
canvas { position: absolute; inset: 0; width: 100%; height: 100%; }
.panel {
  position: absolute; right: 16px; bottom: 16px; width: 328px; max-width: calc(100% - 16px); max-height: calc(100% - 32px);
  display: flex; flex-direction: column; overflow: hidden; pointer-events: auto; background: var(--ground); color: var(--text);
  border: 1px solid var(--line); border-radius: 12px; box-shadow: 0 1px 2px rgb(0 0 0 / .16), 0 12px 40px rgb(0 0 0 / .28);
  font: 13px/1.45 system-ui, sans-serif; font-variant-numeric: tabular-nums; text-align: start; touch-action: manipulation;
}
:is(button, select, summary, input, [tabindex]):focus-visible { outline: 2px solid var(--light); outline-offset: 2px; border-radius: 6px; }
header { display: flex; align-items: center; gap: 2px; padding: 4px 6px; cursor: move; touch-action: none; user-select: none; -webkit-user-select: none; }
h2 { margin: 0; font-size: 13px; font-weight: 650; line-height: 1; }
.state { flex: 1; line-height: 1; padding-block: 3px; margin-inline-start: 8px; color: var(--muted); overflow: hidden; text-overflow: ellipsis; white-space: nowrap; }
button { font: inherit; color: inherit; cursor: pointer; border: 1px solid var(--line); border-radius: 6px; background: var(--raised); padding: 3px 10px; }
header button { width: 32px; height: 32px; padding: 8px; border: 0; background: none; color: var(--muted); }
.grip { cursor: move; }
header button:hover, summary:hover { color: var(--text); background: var(--raised); }
button:disabled { opacity: .5; cursor: default; }
svg { display: block; width: 100%; height: 100%; fill: none; stroke: currentcolor; stroke-width: 1.5; stroke-linecap: round; stroke-linejoin: round; }
.body { overflow: hidden auto; overscroll-behavior: contain; border-top: 1px solid var(--line); }
.now { padding: 10px 14px 12px; display: grid; gap: 5px; }
.row { display: grid; grid-template-columns: minmax(0, 1fr) 92px 38px; gap: 10px; align-items: center; min-height: 19px; }
.row > :first-child, .what { overflow: hidden; text-overflow: ellipsis; white-space: nowrap; }
.row > :last-child { text-align: end; }
.row.none { color: var(--muted); border-top: 1px solid var(--line); padding-top: 5px; }
.past, .past .row[data-intended], .past output { color: var(--muted); }
.past :is(.bar i, svg) { opacity: .55; }
.row[data-intended] { color: var(--light); font-weight: 650; }
.bar { height: 8px; border-radius: 4px; background: var(--track); overflow: hidden; forced-color-adjust: none; }
.bar i { display: block; height: 100%; background: var(--light); transform-origin: 0 50%; transform: scaleX(0); }
.none .bar i { background: var(--quiet); }
.arrival { display: grid; grid-template-columns: 1fr auto; gap: 4px 8px; color: var(--muted); }
.arrival output { color: var(--text); }
.time { grid-column: 1 / -1; height: 22px; }
.time svg { overflow: visible; }
details { border-top: 1px solid var(--line); }
summary { display: flex; align-items: center; gap: 8px; padding: 8px 14px; cursor: pointer; font-weight: 600; list-style: none; }
summary:focus-visible { outline-offset: -2px; }
summary::-webkit-details-marker { display: none; }
summary::before { content: ""; width: 6px; height: 6px; border: solid var(--muted); border-width: 0 1.5px 1.5px 0; transform: rotate(-45deg); }
details[open] > summary::before { transform: translateY(-2px) rotate(45deg); }
summary span { margin-inline-start: auto; font-weight: 400; color: var(--muted); }
.inside { padding: 0 14px 12px; }
ol { margin: 0; padding: 0; list-style: none; max-height: 196px; overflow: auto; overscroll-behavior: contain; }
li { display: grid; grid-template-columns: minmax(0, 1fr) auto; gap: 0 8px; padding: 4px 0; }
li > :nth-child(even) { text-align: end; }
li + li { border-top: 1px solid var(--line); }
li > * { white-space: nowrap; }
small { color: var(--muted); font-size: 12px; }
[data-verdict="wrong"] { color: var(--bad); }
[data-verdict="right"] { color: var(--good); }
p { margin: 0; color: var(--muted); }
dl { display: grid; grid-template-columns: repeat(4, 1fr); gap: 8px; margin: 0 0 10px; }
dt { color: var(--muted); font-size: 12px; }
dd { margin: 0; font-size: 15px; font-weight: 600; white-space: nowrap; }
.plot { display: block; width: 100%; height: auto; }
.plot text { font: 11px system-ui, sans-serif; fill: var(--muted); stroke: none; }
.control { display: grid; grid-template-columns: 104px minmax(0, 1fr) 40px; gap: 8px; align-items: center; min-height: 28px; }
.control output { text-align: end; }
input { width: 100%; height: 24px; margin: 0; accent-color: var(--light); }
select { font: inherit; color: inherit; background: var(--raised); border: 1px solid var(--line); border-radius: 6px; padding: 4px 6px; width: 100%; min-width: 0; }
.actions { display: flex; gap: 8px; margin-top: 8px; align-items: center; }
code { flex: 1; min-width: 0; font: 12px ui-monospace, monospace; overflow-wrap: anywhere; user-select: all; -webkit-user-select: all; }
.watchers { padding: 10px 14px 0; }
.problem { color: var(--bad); }
@media (max-width: 599px) {
  .panel { left: 8px; right: 8px; width: auto; max-width: none; bottom: calc(8px + env(safe-area-inset-bottom, 0px)); max-height: 56%; }
  header button { width: 40px; height: 40px; padding: 12px; }
  summary { padding-block: 12px; }
}
@media (forced-colors: active) {
  .bar i, .none .bar i { background: CanvasText; }
  .bar { border: 1px solid CanvasText; background: Canvas; }
}
`;
