// Shows a fabric at rest and locked. The data is in the page (#fabric), written by plugins/export/page.cpp.
import {
  AmbientLight, ArrowHelper, Box3, BufferAttribute, BufferGeometry, Color, DirectionalLight, Group, InstancedMesh,
  Matrix4, MeshStandardMaterial, PerspectiveCamera, Quaternion, Raycaster, Scene, Vector2, Vector3, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";

const fabric = JSON.parse(document.getElementById("fabric").textContent);
const byId = (id) => document.getElementById(id);

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
const groups = fabric.meshes.map((mesh, number) => {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(bytes(mesh.points)), 3));
  geometry.setIndex(new BufferAttribute(new Uint32Array(bytes(mesh.triangles)), 1));
  geometry.computeVertexNormals();
  const copies = fabric.copies.map((copy, k) => ({ ...copy, k })).filter((copy) => copy.mesh === number);
  const instanced = new InstancedMesh(geometry, new MeshStandardMaterial({ roughness: 0.45, metalness: 0.25 }),
    copies.length);
  instanced.frustumCulled = false;
  copies.forEach((copy, k) => {
    const [r, g, b] = fabric.colours[copy.element % fabric.colours.length];
    instanced.setColorAt(k, new Color().setRGB(r / 255, g / 255, b / 255, "srgb"));
  });
  scene.add(instanced);
  return { instanced, copies };
});

const renderer = new WebGLRenderer({ canvas: byId("view"), antialias: true, preserveDrawingBuffer: true });
const camera = new PerspectiveCamera(30, 1, 0.01, 1e6);
camera.up.set(0, 0, 1);
const controls = new OrbitControls(camera, renderer.domElement);
controls.listenToKeyEvents(renderer.domElement);
const arrows = new Group();
scene.add(arrows);

let state = fabric.states.length > 1 ? 1 : 0;
let part = 1;
let playing = 0;
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

function percent(value) {
  return value === null ? "" : fabric.bends ? `${value.toPrecision(4)} /${fabric.unit}`
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
  byId("label").textContent = state === 0 ? "at rest" : `${chosen.label}: ${percent(chosen.value)}`;
  for (const row of document.querySelectorAll("#limits tbody tr"))
    row.setAttribute("aria-selected", String(Number(row.dataset.state) === state));
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

function makePlot() {
  const shown = fabric.limits.filter((limit) => limit.direction !== null && limit.value !== null);
  if (shown.length < 3) return;
  const most = Math.max(...shown.map((limit) => Math.abs(limit.value)));
  const at = (limit, half) => {
    const angle = limit.direction * Math.PI / 180 + (half ? Math.PI : 0);
    const radius = 88 * Math.abs(limit.value) / most;
    return [100 + radius * Math.cos(angle), 100 - radius * Math.sin(angle)];
  };
  let drawing = "";
  for (const fraction of [0.5, 1])
    drawing += `<circle cx="100" cy="100" r="${88 * fraction}" fill="none" stroke="#ddd"/>`;
  drawing += `<text x="190" y="97" text-anchor="end" font-size="7" fill="#666">${percent(most)}</text>`;
  for (const further of [true, false]) {
    const some = shown.filter((limit) => limit.further === further).sort((a, b) => a.direction - b.direction);
    // All the way round; where directions are far apart nothing is known between them, and nothing is drawn.
    const round = [...some.map((limit) => [limit.direction, at(limit, false)]),
      ...some.map((limit) => [limit.direction + 180, at(limit, true)])];
    const colour = further ? "#2b6cb0" : "#b7791f";
    let path = "";
    round.forEach(([direction, point], k) => {
      const [before] = k > 0 ? round[k - 1] : [-Infinity];
      path += `${direction - before <= 35 ? "L" : "M"}${point.join(",")}`;
    });
    if (round.length > 2 && round[0][0] + 360 - round[round.length - 1][0] <= 35) path += `L${round[0][1].join(",")}`;
    drawing += `<path d="${path}" fill="none" stroke="${colour}"${further ? "" : " stroke-dasharray=\"4 3\""}/>`;
    for (const limit of some.filter((one) => one.state > 0)) {
      for (const half of [false, true]) {
        const [x, y] = at(limit, half);
        drawing += `<circle class="mark" data-state="${limit.state}" cx="${x}" cy="${y}" r="3" fill="${colour}"><title>${
          safe(limit.label)}: ${percent(limit.value)}</title></circle>`;
      }
    }
  }
  byId("plot").innerHTML = `<svg viewBox="0 0 200 200" role="img" aria-label="Limits against direction: ${
    safe(fabric.words[0])} as a line, ${safe(fabric.words[1])} dashed">${drawing}</svg>`;
  for (const mark of document.querySelectorAll("#plot .mark"))
    mark.addEventListener("click", () => choose(Number(mark.dataset.state)));
}

function makeFacts() {
  byId("facts").replaceChildren(...fabric.facts.flatMap(([name, value]) => {
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
    if (part === 1) playing = 0;
    place();
  }
  last = now;
  if (!dirty) return;
  dirty = false;
  sun.position.copy(camera.position).add(new Vector3(-1, 0.5, 1).multiplyScalar(camera.position.length()));
  renderer.render(scene, camera);
  document.documentElement.dataset.frames = String(++frames);
}

document.title = `${fabric.name} - Hauberk`;
byId("title").textContent = fabric.name;
byId("state").replaceChildren(...fabric.states.map((one, k) => new Option(one.label, String(k))));
byId("state").addEventListener("change", () => choose(Number(byId("state").value)));
byId("motion").addEventListener("input", () => {
  playing = 0;
  part = Number(byId("motion").value);
  place();
});
byId("play").addEventListener("click", () => {
  part = 0;
  playing = 1;
});
byId("home").addEventListener("click", whole);
byId("forces").addEventListener("change", place);
controls.addEventListener("change", () => { dirty = true; });
window.addEventListener("resize", resize);
scene.add(sun);
makeTable();
makePlot();
makeFacts();
resize();
choose(state);
whole();
requestAnimationFrame(draw);
