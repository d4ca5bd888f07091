#pragma once

// The constant parts of report.html.
namespace packtrace {

inline constexpr const char* page_style = R"css(
:root { color-scheme: light; --ink: #1c2024; --soft: #5b6570; --line: #d9dee3; --tint: #f4f6f8;
        --mark: #0072b2; }
* { box-sizing: border-box; }
body { font: 16px/1.55 system-ui, sans-serif; color: var(--ink); background: #fff;
       max-width: 1120px; margin: 0 auto; padding: 1.5rem 1rem 4rem; }
h1 { font-size: 1.9rem; line-height: 1.2; margin: 0 0 .5rem; }
h2 { font-size: 1.5rem; margin: 0 0 .75rem; }
h3 { font-size: 1.15rem; margin: 0 0 .25rem; }
p { margin: .25rem 0 .75rem; max-width: 46rem; }
code { font-size: .85em; overflow-wrap: anywhere; }
a { color: var(--mark); }
.soft { color: var(--soft); font-size: .9rem; }
nav { display: flex; flex-wrap: wrap; gap: .25rem 1rem; margin: 1rem 0; }
dl.conditions { display: grid; grid-template-columns: max-content 1fr; gap: .1rem 1rem;
                font-size: .9rem; margin: 1rem 0; }
dl.conditions dt { color: var(--soft); }
dl.conditions dd { margin: 0; min-width: 0; }
details { border: 1px solid var(--line); border-radius: 6px; padding: .5rem .9rem; margin: 1rem 0;
          font-size: .9rem; }
summary { cursor: pointer; font-weight: 600; }
details dt { font-weight: 600; margin-top: .5rem; }
details dd { margin: 0; max-width: 46rem; }
section.scene { border-top: 2px solid var(--ink); margin-top: 2.5rem; padding-top: 1rem; }
section.study { margin-top: 2rem; }
ul.judgement { background: var(--tint); border-left: 4px solid var(--mark); margin: .75rem 0;
               padding: .6rem .9rem .6rem 1.9rem; border-radius: 0 6px 6px 0; }
/* A shadow at an edge says that there is more behind it; covers that scroll along hide it there
   where there is not. */
.scroll, .plot .canvas {
    overflow-x: auto;
    background: linear-gradient(to right, #fff 40%, #fff0) 0 0 / 3rem 100% local,
                linear-gradient(to left, #fff 40%, #fff0) 100% 0 / 3rem 100% local,
                linear-gradient(to right, #0004, #0000) 0 0 / .8rem 100% scroll,
                linear-gradient(to left, #0004, #0000) 100% 0 / .8rem 100% scroll;
    background-repeat: no-repeat;
}
.scroll { margin: .75rem 0; }
table { border-collapse: collapse; font-size: .82rem; width: 100%; }
th, td { padding: .28rem .6rem; text-align: right; white-space: nowrap;
         border-bottom: 1px solid var(--line); font-variant-numeric: tabular-nums;
         vertical-align: top; }
th { background: var(--tint); font-weight: 600; }
th:first-child, td:first-child { text-align: left; padding-left: .4rem; position: sticky; left: 0; }
td:first-child { background: #fff; }
th:last-child, td:last-child { text-align: left; white-space: normal; min-width: 15rem; }
tbody tr:hover td { background: var(--tint); }
tr.yes td:first-child { font-weight: 700; }
tr.undecided td:first-child { font-style: italic; }
.compare { display: flex; flex-wrap: wrap; gap: .5rem; line-height: 0; }
.compare img { display: block; max-width: 100%; height: auto; image-rendering: pixelated; }
.js .compare { display: block; position: relative; width: max-content; max-width: 100%;
               cursor: ew-resize; touch-action: pan-y; user-select: none; }
.js .compare img.right { position: absolute; left: 0; top: 0; }
.compare .edge { display: none; }
.js .compare .edge { display: block; position: absolute; top: 0; bottom: 0; width: 2px;
                     margin-left: -1px; background: #fff; box-shadow: 0 0 2px #000;
                     pointer-events: none; }
.controls, .js .without-script, .plot .series { display: none; }
.js .controls { display: grid; grid-template-columns: 1fr 1fr; gap: .5rem 1rem; margin: .5rem 0;
                max-width: max(20rem, var(--width)); font-size: .85rem; }
.controls label { color: var(--soft); min-width: 0; }
.controls select { display: block; width: 100%; font: inherit; padding: .3rem; }
.controls input { grid-column: 1 / -1; width: 100%; margin: 0; }
.scale { display: flex; align-items: center; gap: .5rem; font-size: .8rem; margin: .4rem 0;
         max-width: max(20rem, var(--width)); flex-wrap: wrap; }
.scale[hidden] { display: none; }
.scale .range { display: flex; flex: 1 1 14rem; align-items: center; gap: .5rem; }
.scale .bar { flex: 1; height: .8rem; border: 1px solid var(--line);
              background: linear-gradient(to right, #000, #00f, #0f0, #ff0, #f00, #fff); }
.plot svg { display: block; width: 100%; min-width: 640px; max-width: 900px; height: auto; }
/* The white ground of a plot would hide the shadows; letters keep some, to be read over lines. */
.plot svg > g > rect:first-child { fill: none; }
.plot svg text { paint-order: stroke; stroke: #fff; stroke-width: 3px; stroke-linejoin: round; }
.plot .swatch { display: inline-block; width: .7rem; height: .7rem; border-radius: 50%;
                margin-right: .3rem; }
.js .plot .series { display: flex; flex-wrap: wrap; gap: .25rem 1rem; font-size: .85rem;
                    margin: .5rem 0 0; }
@media (max-width: 640px) {
    body { padding: 1rem .75rem 3rem; }
    h1 { font-size: 1.5rem; }
    .js .controls { grid-template-columns: 1fr; }
    dl.conditions { grid-template-columns: 1fr; }
    dl.conditions dd { margin-bottom: .4rem; }
    .slider > .scale .soft { flex-basis: 100%; }
    th:last-child, td:last-child { min-width: 22rem; }
    td:first-child { white-space: normal; min-width: 8.5rem; max-width: 9.5rem; }
}
)css";

// Runs before the page is drawn: elements that need scripts are shown only where scripts run.
inline constexpr const char* page_begin_script = "document.documentElement.classList.add('js');";

// A slider draws the right picture over the left one from its mark on. The first two pictures are
// in the page itself. A plot's boxes hide and show the groups that gnuplot made for each series.
inline constexpr const char* page_script = R"js(
const pictures = JSON.parse(document.getElementById('pictures').textContent);

function setUpSlider(box) {
    const compare = box.querySelector('.compare');
    const sides = ['left', 'right'].map(name => ({
        image: box.querySelector('img.' + name),
        choice: box.querySelector('select.' + name),
        scale: box.querySelector('.scale.' + name),
    }));
    const range = box.querySelector('input[type=range]');
    const edge = box.querySelector('.edge');
    sides.forEach(side => { pictures[side.choice.value] = side.image.src; });
    const move = () => {
        sides[1].image.style.clipPath = `inset(0 0 0 ${range.value}%)`;
        edge.style.left = range.value + '%';
    };
    const choose = side => {
        const chosen = side.choice.selectedOptions[0];
        side.image.src = pictures[chosen.value];
        side.image.alt = chosen.textContent;
        side.scale.hidden = !chosen.dataset.most;
        side.scale.querySelector('.least').textContent = chosen.dataset.least || '';
        side.scale.querySelector('.most').textContent = chosen.dataset.most || '';
    };
    const drag = event => {
        const frame = compare.getBoundingClientRect();
        const share = 100 * (event.clientX - frame.left) / frame.width;
        range.value = Math.min(100, Math.max(0, share));
        move();
    };
    range.addEventListener('input', move);
    sides.forEach(side => side.choice.addEventListener('change', () => choose(side)));
    compare.addEventListener('pointerdown', event => { event.preventDefault(); drag(event); });
    compare.addEventListener('pointermove', event => { if (event.buttons) drag(event); });
    move();
}

function setUpPlot(box) {
    const groups = [...box.querySelectorAll('svg g[id^=gnuplot_plot_]')];
    box.querySelectorAll('label input').forEach(input => {
        const wanted = input.dataset.groups.split(' ');
        input.addEventListener('change', () => groups
            .filter(group => wanted.includes(group.id))
            .forEach(group => { group.style.display = input.checked ? '' : 'none'; }));
    });
}

document.querySelectorAll('.slider').forEach(setUpSlider);
document.querySelectorAll('.plot').forEach(setUpPlot);
document.documentElement.dataset.ready = 'yes';
)js";

}  // namespace packtrace
