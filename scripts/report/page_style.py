"""The page's style sheet: light and dark, wide and narrow."""

STYLE = """
:root { color-scheme: light dark; --paper: #fbfbf9; --ink: #1d1d1b; --faint: #5c5c58; --line: #d8d8d2; --card: #ffffff;
  --link: #005a96; --front: #fdeee2; --warn: #fff3cd; --bad: #a3270f; }
@media (prefers-color-scheme: dark) { :root { --paper: #171816; --ink: #e8e8e3; --faint: #a9a9a2; --line: #3b3c38;
  --card: #20211f; --link: #7cc0f2; --front: #3d2a1a; --warn: #453a12; --bad: #ff9d85; } }
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 1.2rem 1rem 3rem; max-width: 72rem; background: var(--paper); color: var(--ink);
  font: 1rem/1.5 system-ui, 'Segoe UI', Roboto, Helvetica, Arial, sans-serif; overflow-wrap: anywhere; }
h1 { font-size: 1.6rem; line-height: 1.2; margin: 0 0 .6rem; }
h2 { font-size: 1.25rem; margin: 2.2rem 0 .6rem; }
h3 { font-size: 1rem; margin: 1.4rem 0 .2rem; }
p, ul { margin: .4rem 0; max-width: 50rem; }
a { color: var(--link); }
.warning { background: var(--warn); padding: .5rem .8rem; border-left: .25rem solid #b58900; }
.failed { color: var(--bad); }
figure { margin: 0; }
figcaption { color: var(--faint); font-size: .875rem; }
.chart { margin: 1.2rem 0 2rem; }
.chart { max-width: 46rem; }
.card { background: #ffffff; border: 1px solid var(--line); border-radius: .4rem; padding: .1rem; }
.card > svg { display: block; width: 100%; height: auto; }
.chart figcaption { margin-top: .5rem; }
.chart figcaption p { margin: .2rem 0; }
.facts { font-size: .8rem; }
.card a:hover path, .card a:focus path { stroke-width: 3; }
.sideways { overflow-x: auto; border: 1px solid var(--line); border-radius: .4rem; background: var(--card); }
table { border-collapse: collapse; font-size: .875rem; width: 100%; overflow-wrap: normal; }
th, td { padding: .3rem .6rem; border-bottom: 1px solid var(--line); text-align: left; vertical-align: top; }
tbody tr:last-child > * { border-bottom: 0; }
thead th { vertical-align: bottom; }
tbody th { font-weight: normal; min-width: min(19rem, 48vw); }
td.number, th.number { text-align: right; font-variant-numeric: tabular-nums; }
td.number { white-space: nowrap; }
tr.front { background: var(--front); }
tr.front th { font-weight: 600; }
.setting:target { outline: 2px solid var(--link); outline-offset: .4rem; }
.pictures { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(16rem, 100%), 1fr)); gap: .6rem; }
.pictures img, .pictures svg { display: block; width: 100%; max-width: 640px; height: auto; image-rendering: auto; }
.none { aspect-ratio: 4 / 3; max-width: 640px; border: 1px dashed var(--line); }
.store { display: block; width: 0; height: 0; position: absolute; }
code { font: .85rem/1.4 ui-monospace, Menlo, Consolas, 'DejaVu Sans Mono', monospace; }
dl { display: grid; grid-template-columns: max-content 1fr; gap: .2rem 1rem; margin: .4rem 0; font-size: .9rem; }
dt { color: var(--faint); }
dd { margin: 0; }
@media print { .card, .sideways { overflow: visible; } }
"""
