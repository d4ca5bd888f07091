#pragma once

// The fixed parts of report.html.
namespace packtrace {

inline constexpr const char* page_style = R"css(
body { font: 15px/1.5 system-ui, sans-serif; max-width: 1200px; margin: 2rem auto; padding: 0 1rem;
       color: #222; }
table { border-collapse: collapse; font-size: 13px; margin: 1rem 0; }
th, td { padding: 2px 10px; text-align: right; border-bottom: 1px solid #ddd; }
th:first-child, td:first-child, td:last-child { text-align: left; }
tr.pareto td:first-child { font-weight: bold; }
.compare { position: relative; width: max-content; max-width: 100%; line-height: 0; }
.compare img { display: block; max-width: 100%; image-rendering: pixelated; }
.compare img.right { position: absolute; left: 0; top: 0; }
.controls { margin: .5rem 0; display: flex; gap: 1rem; flex-wrap: wrap; align-items: center; }
.controls input[type=range] { width: 320px; }
.plot svg { max-width: 900px; height: auto; }
.plot label { margin-right: 1rem; font-size: 13px; white-space: nowrap; }
)css";

// A slider draws the right picture over the left one from its mark on. A plot's boxes hide and show
// what gnuplot put into a group of its own for each series.
inline constexpr const char* page_script = R"js(
const pictures = JSON.parse(document.getElementById('pictures').textContent);

function setUpSlider(box) {
    const left = box.querySelector('img.left');
    const right = box.querySelector('img.right');
    const range = box.querySelector('input[type=range]');
    const choices = box.querySelectorAll('select');
    const update = () => {
        left.src = pictures[choices[0].value];
        right.src = pictures[choices[1].value];
        right.style.clipPath = `inset(0 0 0 ${range.value}%)`;
    };
    range.addEventListener('input', update);
    choices.forEach(choice => choice.addEventListener('change', update));
    update();
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
