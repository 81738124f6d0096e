// Shows fabrics at rest and locked. The data is in the page (#fabric), written by plugins/export/page.cpp: results, each
// with its fabrics (of a design as it was, its iterates, as it became), each with its states.
import {
  AmbientLight, ArrowHelper, Box3, BufferAttribute, BufferGeometry, Color, DirectionalLight, Group, InstancedMesh,
  Matrix4, MeshStandardMaterial, PerspectiveCamera, Quaternion, Raycaster, Scene, Vector2, Vector3, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";

const data = JSON.parse(document.getElementById("fabric").textContent);
const byId = (id) => document.getElementById(id);
let result = data.results[0];
let fabric = result.fabrics[result.fabrics.length - 1];

function bytes(base64) {
  const text = atob(base64);
  const out = new Uint8Array(text.length);
  for (let k = 0; k < text.length; ++k) out[k] = text.charCodeAt(k);
  return out.buffer;
}

// Meshes, each with all copies of it.
const scene = new Scene();
scene.background = new Color(0xf6f7f8);
scene.add(new AmbientLight(0xffffff, 1.1));
const sun = new DirectionalLight(0xffffff, 2.2);
scene.add(sun);
let groups = [];

// The meshes of the fabric in place of those that were shown.
function makeMeshes() {
  for (const { instanced } of groups) {
    scene.remove(instanced);
    instanced.geometry.dispose();
    instanced.material.dispose();
    instanced.dispose();
  }
  groups = fabric.meshes.map(meshGroup);
}

function meshGroup(mesh, number) {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(bytes(mesh.points)), 3));
  geometry.setIndex(new BufferAttribute(new Uint32Array(bytes(mesh.triangles)), 1));
  geometry.computeVertexNormals();
  const copies = fabric.copies.map((copy, k) => ({ ...copy, k })).filter((copy) => copy.mesh === number);
  const instanced = new InstancedMesh(geometry, new MeshStandardMaterial({ roughness: 0.45, metalness: 0.25 }),
    copies.length);
  instanced.frustumCulled = false;
  copies.forEach((copy, k) => {
    const [r, g, b] = data.colours[copy.element % data.colours.length];
    instanced.setColorAt(k, new Color().setRGB(r / 255, g / 255, b / 255, "srgb"));
  });
  scene.add(instanced);
  return { instanced, copies };
}

const renderer = new WebGLRenderer({ canvas: byId("view"), antialias: true, preserveDrawingBuffer: true });
const camera = new PerspectiveCamera(30, 1, 0.01, 1e6);
camera.up.set(0, 0, 1);
const controls = new OrbitControls(camera, renderer.domElement);
controls.listenToKeyEvents(renderer.domElement);
const arrows = new Group();
scene.add(arrows);

let state = 0;
let part = 1;
let playing = false;
let evolving = false;  // from design to design
let shownAt = 0;  // when the last one of them was shown
let dirty = true;

function pose(numbers) {
  return {
    position: new Vector3(numbers[0], numbers[1], numbers[2]),
    turn: new Quaternion(numbers[4], numbers[5], numbers[6], numbers[3]),
  };
}

// Places change evenly between rest and the state: a picture of the motion, not the certified one.
function place() {
  const one = new Vector3(1, 1, 1);
  const matrix = new Matrix4();
  const there = fabric.states[state].poses;
  for (const { instanced, copies } of groups) {
    copies.forEach((copy, k) => {
      const from = pose(fabric.states[0].poses[copy.k]);
      const to = pose(there[copy.k]);
      matrix.compose(from.position.lerp(to.position, part), from.turn.slerp(to.turn, part), one);
      instanced.setMatrixAt(k, matrix);
    });
    instanced.instanceMatrix.needsUpdate = true;
    instanced.computeBoundingSphere();
  }
  arrows.visible = byId("forces").checked && part === 1;
  dirty = true;
}

function makeArrows() {
  arrows.clear();
  const forces = fabric.states[state].forces;
  const most = Math.max(...forces.map((force) => force.size), 0);
  for (const force of forces) {
    const length = fabric.size * 0.9 * Math.sqrt(force.size / most);
    const arrow = new ArrowHelper(new Vector3(...force.normal), new Vector3(...force.at), length, 0xc02020,
      0.3 * length, 0.15 * length);
    arrow.userData.name = `${force.pair}: ${(100 * force.size / most).toFixed(0)} % of the largest force`;
    arrows.add(arrow);
  }
}

function whole() {
  const box = new Box3();
  for (const { instanced } of groups) {
    instanced.computeBoundingBox();
    box.union(instanced.boundingBox);
  }
  const middle = box.getCenter(new Vector3());
  const radius = 0.5 * box.getSize(new Vector3()).length();
  const away = 0.85 * radius / Math.sin(0.5 * camera.fov * Math.PI / 180) / Math.min(1, camera.aspect);
  controls.target.copy(middle);
  camera.position.copy(middle).addScaledVector(new Vector3(0.35, -0.75, 0.9).normalize(), away);
  camera.near = away / 1000;
  camera.far = away * 10;
  camera.updateProjectionMatrix();
  controls.update();
  dirty = true;
}

function percent(value, of = result) {
  return value === null ? "" : of.bends ? `${value.toPrecision(4)} /${of.unit}`
    : `${value >= 0 ? "+" : ""}${(100 * value).toFixed(2)} %`;
}

function choose(next) {
  state = next;
  part = 1;
  byId("motion").value = 1;
  byId("state").value = String(state);
  byId("motion").disabled = state === 0;
  byId("play").disabled = state === 0;
  const chosen = fabric.states[state];
  const where = state === 0 ? "at rest" : `${chosen.label}: ${percent(chosen.value)}`;
  byId("label").textContent = fabric.label ? `${fabric.label}, ${where}` : where;
  for (const row of document.querySelectorAll("#limits tbody tr"))
    row.setAttribute("aria-selected", String(state > 0 && Number(row.dataset.state) === state));
  for (const mark of document.querySelectorAll("#plot .mark"))
    mark.setAttribute("r", Number(mark.dataset.state) === state ? 5 : 3);
  makeArrows();
  place();
}

// Names come from files that anybody may have written.
const safe = (text) => String(text).replace(/[&<>"']/g, (c) => `&#${c.charCodeAt(0)};`);

// Table and plot of all limits, also of those that have no state to show.
function makeTable() {
  const rows = fabric.limits.map((limit) => {
    const shown = limit.state > 0;
    const name = shown ? `<button type="button">${safe(limit.label)}</button>` : safe(limit.label);
    return `<tr data-state="${limit.state}" aria-selected="false"><td>${name}</td><td class="number">${
      percent(limit.value)}</td><td>${safe(limit.status)}${limit.confidence ? `, ${safe(limit.confidence)}` : ""}</td></tr>`;
  });
  byId("limits").innerHTML =
    `<thead><tr><th>limit</th><th>value</th><th>status</th></tr></thead><tbody>${rows.join("")}</tbody>`;
  for (const button of document.querySelectorAll("#limits button"))
    button.addEventListener("click", () => choose(Number(button.closest("tr").dataset.state)));
}

// A curve through the limits of one sense, and through their mirror images at the other half of the circle. Where
// directions are far apart nothing is known between them, and nothing is drawn.
function curve(limits, at, further, stroke) {
  const some = limits.filter((limit) => limit.further === further).sort((a, b) => a.direction - b.direction);
  const round = [...some.map((limit) => [limit.direction, at(limit, false)]),
    ...some.map((limit) => [limit.direction + 180, at(limit, true)])];
  let path = "";
  round.forEach(([direction, point], k) => {
    const [before] = k > 0 ? round[k - 1] : [-Infinity];
    path += `${direction - before <= 35 ? "L" : "M"}${point.join(",")}`;
  });
  if (round.length > 2 && round[0][0] + 360 - round[round.length - 1][0] <= 35) path += `L${round[0][1].join(",")}`;
  return `<path d="${path}" fill="none" stroke="${stroke}"${further ? "" : " stroke-dasharray=\"4 3\""}/>`;
}

// A bound: a bar at its value, across the direction, with an arrowhead to what is allowed.
function bound(target, x, y) {
  const outward = target.aim === "no_nearer" ? 1 : -1;
  const length = Math.hypot(x - 100, y - 100) || 1;
  const [u, v] = [outward * (x - 100) / length, outward * (y - 100) / length];
  return `<path class="target" d="M${x - 2 * v},${y + 2 * u}L${x + 2 * v},${y - 2 * u}L${x + 7 * u},${y + 7 * v}Z M${
    x - 4 * v},${y + 4 * u}L${x + 4 * v},${y - 4 * u}Z" fill="#444" stroke="#444"><title>${safe(target.aim.replace("_", " "))} than ${percent(target.value)}</title></path>`;
}

// Limits of the fabric against direction; of a design also those of its other fabrics, pale, and its targets.
function makePlot() {
  const drawn = (one) => one.limits.filter((limit) => limit.direction !== null && limit.value !== null);
  const all = [...result.fabrics.flatMap(drawn), ...result.targets];
  byId("plot").replaceChildren();
  if (all.length < 3) return;
  const most = Math.max(...all.map((one) => Math.abs(one.value)));
  const at = (limit, half) => {
    const angle = limit.direction * Math.PI / 180 + (half ? Math.PI : 0);
    const radius = 88 * Math.abs(limit.value) / most;
    return [100 + radius * Math.cos(angle), 100 - radius * Math.sin(angle)];
  };
  let drawing = "";
  for (const fraction of [0.5, 1])
    drawing += `<circle cx="100" cy="100" r="${88 * fraction}" fill="none" stroke="#ddd"/>`;
  drawing += `<text x="190" y="97" text-anchor="end" font-size="7" fill="#666">${percent(most)}</text>`;
  for (const other of result.fabrics.filter((one) => one !== fabric))
    for (const further of [true, false]) drawing += curve(drawn(other), at, further, "#c9c9c9");
  for (const target of result.targets) {
    for (const half of [false, true]) {
      const [x, y] = at(target, half);
      drawing += target.aim === "reach" ? `<path class="target" d="M${x - 3},${y - 3}L${x + 3},${y + 3}M${x - 3},${
        y + 3}L${x + 3},${y - 3}" stroke="#444"><title>target: ${percent(target.value)}</title></path>` :
        bound(target, x, y);
    }
  }
  for (const further of [true, false]) {
    const colour = further ? "#2b6cb0" : "#b7791f";
    drawing += curve(drawn(fabric), at, further, colour);
    for (const limit of drawn(fabric).filter((one) => one.state > 0 && one.further === further)) {
      for (const half of [false, true]) {
        const [x, y] = at(limit, half);
        drawing += `<circle class="mark" data-state="${limit.state}" cx="${x}" cy="${y}" r="3" fill="${colour}"><title>${
          safe(limit.label)}: ${percent(limit.value)}</title></circle>`;
      }
    }
  }
  byId("plot").innerHTML = `<svg viewBox="0 0 200 200" role="img" aria-label="Limits against direction: ${
    safe(result.words[0])} as a line, ${safe(result.words[1])} dashed${
    result.targets.some((one) => one.aim === "reach") ? ", targets as crosses" : ""}${
    result.targets.some((one) => one.aim !== "reach") ? ", bounds as bars with an arrowhead to what is allowed" : ""}">${
    drawing}</svg>`;
  for (const mark of document.querySelectorAll("#plot .mark"))
    mark.addEventListener("click", () => choose(Number(mark.dataset.state)));
}

// Extreme values of one sense, as a cell of the table of results.
function range(one, further) {
  const { limits } = one.fabrics[one.fabrics.length - 1];
  const values = limits.filter((limit) => limit.further === further && limit.value !== null)
    .map((limit) => limit.value);
  if (values.length === 0) return "";
  const [least, most] = [Math.min(...values), Math.max(...values)].map((value) => percent(value, one));
  return least === most ? least : `${least.replace(" %", "")} to ${most}`;
}

// All results, to compare them; each is shown when its name is pressed.
function makeResults() {
  if (data.results.length < 2) return;
  const rows = data.results.map((one, k) => {
    return `<tr data-result="${k}"><td><button type="button">${safe(one.name)}</button></td><td class="number">${
      range(one, true)}</td><td class="number">${range(one, false)}</td></tr>`;
  });
  const named = (k) => [...new Set(data.results.map((one) => one.words[k]))].join(", ");
  const [further, back] = [named(0), named(1)];
  byId("results").innerHTML = `<thead><tr><th>result</th><th>${safe(further)}</th><th>${
    safe(back)}</th></tr></thead><tbody>${rows.join("")}</tbody>`;
  for (const button of document.querySelectorAll("#results button"))
    button.addEventListener("click", () => showResult(Number(button.closest("tr").dataset.result)));
}

// Another fabric of the result; the state stays that of the same name, if there is one.
function showFabric(number) {
  const name = fabric.states[state].label;
  fabric = result.fabrics[number];
  byId("design").value = number;
  byId("design").setAttribute("aria-valuetext", fabric.label);
  byId("state").replaceChildren(...fabric.states.map((one, k) => new Option(one.label, String(k))));
  makeMeshes();
  makeTable();
  makePlot();
  state = Math.max(0, fabric.states.findIndex((one) => one.label === name));
  choose(state);
}

function showResult(number) {
  result = data.results[number];
  const last = result.fabrics.length - 1;
  evolving = false;
  playing = false;
  document.title = `${result.name} - Hauberk`;
  byId("title").textContent = result.name;
  byId("designs").hidden = last === 0;
  byId("design").max = last;
  for (const row of document.querySelectorAll("#results tbody tr"))
    row.setAttribute("aria-selected", String(Number(row.dataset.result) === number));
  fabric = result.fabrics[last];
  state = Math.min(1, fabric.states.length - 1);
  showFabric(last);
  makeFacts();
  byId("figures").replaceChildren(...result.figures.map((figure) => {
    const image = document.createElement("img");
    image.src = `data:image/svg+xml;base64,${figure.svg}`;
    image.alt = figure.name;
    return image;
  }));
  whole();
}

function makeFacts() {
  byId("facts").replaceChildren(...[...result.facts, ["elements shown", fabric.copies.length]].flatMap(([name, value]) => {
    const term = document.createElement("dt");
    const text = document.createElement("dd");
    term.textContent = name;
    text.textContent = value;
    return [term, text];
  }));
}

// The name of what is under the pointer.
const ray = new Raycaster();
renderer.domElement.addEventListener("pointermove", (event) => {
  const box = renderer.domElement.getBoundingClientRect();
  ray.setFromCamera(new Vector2(2 * (event.clientX - box.left) / box.width - 1,
    1 - 2 * (event.clientY - box.top) / box.height), camera);
  const arrow = arrows.visible ? ray.intersectObject(arrows, true)[0] : undefined;
  const hit = ray.intersectObjects(groups.map((group) => group.instanced))[0];
  const group = hit && groups.find((one) => one.instanced === hit.object);
  byId("pointed").textContent = arrow ? arrow.object.parent.userData.name
    : group ? group.copies[hit.instanceId].name : "";
});

function resize() {
  const stage = byId("stage");
  renderer.setPixelRatio(Math.min(2, window.devicePixelRatio));
  renderer.setSize(stage.clientWidth, stage.clientHeight, false);
  camera.aspect = stage.clientWidth / Math.max(1, stage.clientHeight);
  camera.updateProjectionMatrix();
  dirty = true;
}

let last = 0;
let frames = 0;
function draw(now) {
  requestAnimationFrame(draw);
  if (playing) {
    part = Math.min(1, part + (now - last) / 2000);
    byId("motion").value = part;
    if (part === 1) playing = false;
    place();
  }
  if (evolving && now - shownAt > 600) {
    shownAt = now;
    const next = result.fabrics.indexOf(fabric) + 1;
    if (next < result.fabrics.length) showFabric(next);
    evolving = next + 1 < result.fabrics.length;
  }
  last = now;
  if (!dirty) return;
  dirty = false;
  sun.position.copy(camera.position).add(new Vector3(-1, 0.5, 1).multiplyScalar(camera.position.length()));
  renderer.render(scene, camera);
  document.documentElement.dataset.frames = String(++frames);
}

byId("state").addEventListener("change", () => choose(Number(byId("state").value)));
byId("motion").addEventListener("input", () => {
  playing = false;
  part = Number(byId("motion").value);
  place();
});
byId("play").addEventListener("click", () => {
  part = 0;
  playing = true;
});
byId("design").addEventListener("input", () => {
  evolving = false;
  showFabric(Number(byId("design").value));
});
byId("evolve").addEventListener("click", () => {
  showFabric(0);
  evolving = true;
  shownAt = performance.now();
});
byId("home").addEventListener("click", whole);
byId("forces").addEventListener("change", place);
controls.addEventListener("change", () => { dirty = true; });
window.addEventListener("resize", resize);
makeResults();
resize();
showResult(0);
requestAnimationFrame(draw);
