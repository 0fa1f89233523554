"use strict";
const bundles = JSON.parse(document.getElementById("data").textContent);
const figure = JSON.parse(document.getElementById("figure").textContent);
const drawing = document.getElementById("bundles");
const slider = document.getElementById("time");
const told = document.getElementById("told");
const play = document.getElementById("play");
const frames = Math.max(...bundles.map(b => b.t.length));
// Below this width bundles stand above one another.
const NARROW = 800;

// Points of a tube around an axis along X, ring after ring.
function ring(at, radius, sides, points) {
  for (let a = 0; a < sides; a++) {
    const angle = 2 * Math.PI * a / sides;
    points.x.push(at[0]);
    points.y.push(at[1] + radius * Math.cos(angle));
    points.z.push(at[2] + radius * Math.sin(angle));
  }
}

function empty() { return {x: [], y: [], z: []}; }

function core(bundle, frame) {
  const [y, z, radius] = bundle.core[frame];
  const points = empty();
  for (const x of bundle.X) ring([x, y, z], radius, bundle.coreSides, points);
  return points;
}

function fibre(bundle, frame, k) {
  const points = empty(), path = bundle.paths[frame];
  for (let node = 0; node < bundle.nodes; node++) {
    const first = 3 * (k * bundle.nodes + node);
    const at = [0, 1, 2].map(c => path[first + c] * bundle.grain);
    if (bundle.sides) ring(at, bundle.radius, bundle.sides, points);
    else { points.x.push(at[0]); points.y.push(at[1]); points.z.push(at[2]); }
  }
  return points;
}

function show(frame) {
  const change = {x: [], y: [], z: []}, traces = [];
  for (const bundle of bundles) {
    const at = Math.min(frame, bundle.t.length - 1);
    const shapes = bundle.core.length ? [core(bundle, at)] : [];
    for (let k = 0; k < bundle.fibres; k++) shapes.push(fibre(bundle, at, k));
    // The groove comes first, and stays.
    shapes.forEach((points, i) => {
      for (const c of "xyz") change[c].push(points[c]);
      traces.push(bundle.first + 1 + i);
    });
  }
  const longest = bundles.reduce((a, b) => a.t.length >= b.t.length ? a : b);
  told.textContent = `t = ${(1e3 * longest.t[frame]).toFixed(3)} ms`;
  slider.value = frame;
  return Plotly.restyle(drawing, change, traces);
}

function arrange() {
  const n = bundles.length, stacked = innerWidth < NARROW, change = {};
  bundles.forEach((bundle, i) => {
    const part = [i / n, (i + 1) / n];
    change[`${bundle.scene}.domain.x`] = stacked ? [0, 1] : part;
    change[`${bundle.scene}.domain.y`] = stacked ? [1 - part[1], 1 - part[0]] : [0, 1];
  });
  const free = innerHeight - drawing.getBoundingClientRect().top - scrollY - 24;
  change.height = stacked ? n * Math.max(320, 0.9 * innerWidth) : Math.max(380, free);
  change.annotations = bundles.map((bundle, i) => ({
    text: `<b>${bundle.name}</b>`, font: {size: 16, color: "#1d2126"}, showarrow: false, xref: "paper", yref: "paper",
    x: change[`${bundle.scene}.domain.x`][0], y: change[`${bundle.scene}.domain.y`][1], xanchor: "left", yanchor: "top",
  }));
  return Plotly.relayout(drawing, change);
}

let playing = null;
function stop() {
  clearInterval(playing);
  playing = null;
  play.textContent = "Play";
}
play.addEventListener("click", () => {
  if (playing !== null) { stop(); return; }
  if (+slider.value === frames - 1) slider.value = 0;
  play.textContent = "Pause";
  playing = setInterval(() => {
    if (+slider.value === frames - 1) stop();
    else show(+slider.value + 1);
  }, 120);
});
slider.max = frames - 1;
slider.addEventListener("input", () => { stop(); show(+slider.value); });
addEventListener("resize", arrange);
Plotly.newPlot(drawing, figure.data, figure.layout, {displaylogo: false, responsive: true})
  .then(() => show(frames - 1)).then(arrange).then(() => { document.body.dataset.ready = "yes"; });
