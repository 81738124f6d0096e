// Exported files before readers that know nothing of this project: gltf-validator (GLB) and manifold (bodies of OBJ).
//
//   judges_test.mjs HAUBERK SOURCE_FOLDER
//
// Of every shipped experiment that is exported within a few seconds:
//   GLB   no error and no warning;
//   OBJ   each body is an oriented manifold of one piece, with the holes that its element has (where they are listed
//         below) and the volume that `export` says; the union of all bodies has their summed volume, so none overlap; the
//         smallest gap between two bodies is the one that `export` says, less or more than it by at most both chords.
// Exit code 77: the judges are not installed (npm ci in this folder).

import { execFileSync } from 'node:child_process';
import { mkdtempSync, readdirSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, join } from 'node:path';

let Module, validator;
try {
  Module = (await import('manifold-3d')).default;
  validator = (await import('gltf-validator')).default;
} catch {
  console.log('judges: not installed: npm ci in tests/judges');
  process.exit(77);
}
const manifold = await Module();
manifold.setup();
const { Manifold, Mesh } = manifold;

const [hauberk, source] = process.argv.slice(2);
const folder = mkdtempSync(join(tmpdir(), 'hauberk-judges-'));
const failures = [];
const chordMm = 0.1;

/// Holes of the elements of some experiments: the first Betti number of the solid, counted by hand. (Three great circles
/// meet in six points and have twelve arcs: 12 - 6 + 1.)
const holes = {
  chain: { link: 1 }, chainmail_limits: { ring: 1 }, european_4in1: { ring: 1 },
  boundary_threefold: { threefold: 4 }, fourfold_limits: { fourfold: 7 },
  tetrahedra: { cage: 3 }, diamond_tetrahedra: { cage: 3 }, cubes: { cage: 5 }, octahedra: { cage: 7 }, bent_links: { bent: 3 },
};

function check(holds, scene, what) {
  if (!holds) {
    failures.push(`${scene}: ${what}`);
    console.log(`FAIL ${scene}: ${what}`);
  }
}

function exported(file, name, ...options) {
  const out = join(folder, name);
  const said = execFileSync(hauberk, ['export', file, '-o', out, ...options], { encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'] });
  return { out, said };
}

/// Name and mesh of every group of an OBJ file.
function bodiesOf(path) {
  const points = [], groups = [];
  for (const line of readFileSync(path, 'utf8').split('\n')) {
    const [kind, ...words] = line.split(' ');
    if (kind === 'v') points.push(words.map(Number));
    if (kind === 'g') groups.push({ name: words[0], faces: [] });
    if (kind === 'f') groups.at(-1).faces.push(words.map((w) => parseInt(w, 10) - 1));
  }
  return groups.map(({ name, faces }) => {
    const own = new Map(), vertices = [], triangles = [];
    for (const p of faces.flat()) {
      if (!own.has(p)) {
        own.set(p, own.size);
        vertices.push(...points[p]);
      }
      triangles.push(own.get(p));
    }
    return { name, mesh: new Mesh({ numProp: 3, vertProperties: Float32Array.from(vertices), triVerts: Uint32Array.from(triangles) }) };
  });
}

function judgeBodies(scene, file) {
  const { out, said } = exported(file, `${scene}.obj`, '--chord', String(chordMm));
  const bodies = bodiesOf(out).map(({ name, mesh }) => {
    const solid = new Manifold(mesh);
    check(solid.status() === 'NoError', scene, `${name}: ${solid.status()}`);
    const type = name.replace(/_\d+$/, ''), parts = solid.decompose().length;
    check(parts === 1, scene, `${name} is in ${parts} pieces`);
    const expected = holes[scene]?.[type];
    check(expected === undefined || solid.genus() === expected, scene, `${name} has ${solid.genus()} holes, not ${expected}`);
    if (expected !== undefined) ++counted;
    return solid;
  });
  const volume = bodies.reduce((sum, b) => sum + b.volume(), 0);
  const saidVolume = Number(/volume ([\d.eE+-]+)/.exec(said)[1]);
  check(Math.abs(volume - saidVolume) < 1e-5 * volume, scene, `volume ${volume}, export says ${saidVolume}`);
  // Chords lie outside of necks: what is nearer than two of them may overlap as a mesh.
  const gap = Number(/smallest gap ([\d.eE+-]+)/.exec(said)?.[1] ?? Infinity);
  const union = Manifold.union(bodies);
  check(gap < 2 * chordMm || Math.abs(union.volume() - volume) < 1e-6 * volume, scene, `the union has volume ${union.volume()}, the bodies ${volume}`);
  if (gap < 5) {
    const far = gap + 2 * chordMm;  // where the search of the judge ends
    let least = far;
    for (let i = 0; i < bodies.length; ++i) {
      for (let j = 0; j < i; ++j) least = Math.min(least, bodies[i].minGap(bodies[j], far));
    }
    check(least < far && least > gap - 2 * chordMm, scene, `smallest gap ${least}, export says ${gap}`);
    ++gaps;
  }
  return bodies.length;
}

async function judgeGlb(scene, file) {
  const { out } = exported(file, `${scene}.glb`);
  const { issues } = await validator.validateBytes(new Uint8Array(readFileSync(out)));
  for (const m of issues.messages.filter((m) => m.severity <= 1)) check(false, scene, `GLB: ${m.code} ${m.pointer}: ${m.message}`);
  check(issues.truncated === false, scene, 'GLB: too many issues');
}

let scenes = 0, bodies = 0, counted = 0, gaps = 0;
try {
  const experiments = join(source, 'share', 'experiments');
  for (const name of readdirSync(experiments).filter((n) => n.endsWith('.json')).sort()) {
    const scene = basename(name, '.json'), file = join(experiments, name);
    await judgeGlb(scene, file);
    bodies += judgeBodies(scene, file);
    ++scenes;
  }
} finally {
  rmSync(folder, { recursive: true });
}
console.log(`${scenes} scenes, ${bodies} bodies (${counted} with their holes counted), ${gaps} gaps: ${failures.length} failures`);
process.exit(failures.length > 0 || scenes < 20 ? 1 : 0);
