// Opens pages of `hauberk export` in headless Chromium and uses every control of them.
//
//   node page_test.mjs HAUBERK CHECKOUT
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import assert from "node:assert/strict";

const [hauberk, checkout] = process.argv.slice(2);
const playwright = join(checkout, "share/web/node_modules/playwright-core/index.mjs");
const chromium = ["/usr/bin/chromium", "/usr/bin/chromium-browser"].find(existsSync);
if (!existsSync(playwright) || !chromium) {
  console.log("skipped: needs Chromium, and share/setup.sh --viewer for playwright-core");
  process.exit(77);
}
const browsers = await import(playwright);
const folder = mkdtempSync(join(tmpdir(), "hauberk-page-"));

function run(...words) {
  return execFileSync(hauberk, words, { encoding: "utf8" });
}

function write(name, experiment) {
  writeFileSync(join(folder, `${name}.json`), JSON.stringify(experiment));
  run("run", join(folder, `${name}.json`), "-o", join(folder, name), "--quiet");
  return join(folder, name);
}

// A sheet with limits all the way round, whose name would end the script if it were not written with care.
const rolled = write("rolled", {
  name: "@VIEWER@", task: "limits", length_unit: "mm",
  elements: { link: { shape: "torus_union", tori: [{ name: "ring" }],
    parameters: { "ring.R": 5, "ring.r0": 2.4, "ring.r1": 2.4 } } },
  cell: { patch: { vectors: [[100, 0], [0, 100]], outline: { rectangle: [1, 1] } }, place: [
    { element: "link", position: [0, 0, 0] },
    { element: "link", position: [4.330127018922193, 2.5, 0], rotation: { axis: [4.330127018922193, 2.5, 0], degrees: 90 } }] },
  load_case: { plugin: "cylinder_roll", directions_deg: [30], hold: ["places", "twist", "transverse"] },
});
const sheet = write("sheet", {
  name: "</script><b>sheet", task: "limits", length_unit: "mm", cell: { weave: { name: "european_4in1" } },
  load_case: { plugin: "in_plane_periodic", directions_deg: [0, 30, 60, 90, 120, 150], senses: ["stretch"] },
});
const html = join(folder, "sheet.html");
run("export", sheet, "-o", html, "--repeat", "4,4");
assert.ok(statSync(html).size < 4e6, `${statSync(html).size} bytes`);

const browser = await browsers.chromium.launch({
  executablePath: chromium,
  args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-background-networking",
    "--disable-component-update", "--disable-sync", "--no-first-run"],
});
try {
  const page = await browser.newPage({ viewport: { width: 1000, height: 640 } });
  const wrong = [];
  page.on("pageerror", (error) => wrong.push(error.message));
  page.on("console", (message) => { if (message.type() === "error") wrong.push(message.text()); });
  page.on("request", (request) => { if (!request.url().startsWith("file:")) wrong.push(request.url()); });
  await page.goto(`file://${html}`);
  const frames = () => page.evaluate(() => Number(document.documentElement.dataset.frames ?? 0));
  await page.waitForFunction(() => Number(document.documentElement.dataset.frames) > 0);

  /// Pixels of the canvas as they are now.
  const picture = async () => {
    const before = await frames();
    await page.evaluate(() => window.dispatchEvent(new Event("resize")));
    await page.waitForFunction((count) => Number(document.documentElement.dataset.frames) > count, before);
    return page.evaluate(() => {
      const view = document.getElementById("view");
      const copy = document.createElement("canvas");
      copy.width = 200;
      copy.height = 128;
      const pen = copy.getContext("2d");
      pen.drawImage(view, 0, 0, 200, 128);
      return [...pen.getImageData(0, 0, 200, 128).data];
    });
  };
  const difference = (a, b) => a.filter((value, k) => Math.abs(value - b[k]) > 40).length / a.length;
  const label = () => page.textContent("#label");

  // What is on the page.
  assert.equal(await page.textContent("#title"), "</script><b>sheet");
  assert.equal(await page.locator("#limits tbody tr").count(), 6);
  assert.equal(await page.locator("#plot .mark").count(), 12, "a mark for each limit, and one opposite");
  assert.match(await label(), /^stretch at 0°: \+\d+\.\d\d %$/);
  const locked = await picture();
  const background = locked.slice(0, 3);
  const covered = locked.filter((value, k) => k % 4 === 0 && Math.abs(value - background[0]) > 30).length / (200 * 128);
  assert.ok(covered > 0.1 && covered < 0.9, `${covered} of the view is fabric`);

  // State, motion.
  await page.selectOption("#state", { label: "at rest" });
  assert.equal(await label(), "at rest");
  assert.ok(await page.isDisabled("#play"), "there is no motion from rest to rest");
  const rest = await picture();
  assert.ok(difference(locked, rest) > 0.002, "rest looks like the locked state");
  await page.click("#limits tbody tr:nth-child(4) button");
  assert.match(await label(), /^stretch at 90°/);
  assert.equal(await page.inputValue("#state"), "4");
  assert.equal(await page.getAttribute("#limits tbody tr:nth-child(4)", "aria-selected"), "true");
  await page.fill("#motion", "0");
  assert.ok(difference(await picture(), rest) < 1e-3, "where the motion begins is not rest");
  await page.click("#play");
  await page.waitForFunction(() => document.getElementById("motion").value === "1");
  assert.ok(difference(await picture(), rest) > 0.002);
  await page.locator("#plot .mark").nth(2).click();
  assert.match(await label(), /^stretch at 30°/);

  // Forces, the name under the pointer, the keyboard.
  const without = await picture();
  await page.check("#forces");
  assert.ok(difference(without, await picture()) > 0, "no arrow is seen");
  const names = new Set();
  for (let x = 260; x <= 420; x += 20) {
    await page.mouse.move(x, 320);
    names.add(await page.textContent("#pointed"));
  }
  assert.ok([...names].some((name) => /^ring \d+ \[\d, \d\]$/.test(name)), [...names].join("; "));
  await page.mouse.move(340, 320);
  await page.mouse.down();
  await page.mouse.move(440, 280, { steps: 4 });
  await page.mouse.up();
  const turned = await picture();
  assert.ok(difference(turned, without) > 0.01, "dragging does not turn it");
  await page.click("#home");
  assert.ok(difference(await picture(), turned) > 0.01);
  await page.focus("#view");
  const here = await picture();
  for (let k = 0; k < 5; ++k) await page.keyboard.press("ArrowLeft");
  assert.ok(difference(await picture(), here) > 0.005, "keys do not move it");

  // What a screen reader says of every control.
  for (const id of ["view", "state", "motion", "play", "home", "forces", "design", "evolve"]) {
    const name = await page.evaluate((of) => {
      const control = document.getElementById(of);
      return (control.getAttribute("aria-label") ?? control.labels?.[0]?.textContent ?? control.textContent).trim();
    }, id);
    assert.ok(name.length > 3, `#${id} has no name`);
  }

  // A run that leaves its page: a design as it was, on its way, and as it became.
  const made = join(folder, "designed");
  run("run", join(checkout, "optimizers/sqp/example.json"), "-o", made, "--html", "--quiet");
  const history = JSON.parse(readFileSync(join(made, "results.json"), "utf8")).design.history;
  assert.ok(history.length > 3 && history.every((iterate) => iterate.variables.length === 1));
  await page.goto(`file://${join(made, "report.html")}`);
  await page.waitForFunction(() => Number(document.documentElement.dataset.frames) > 0);
  assert.match(await label(), /^designed, stretch at 0°: \+50\.00 %$/);
  const designed = await picture();
  assert.equal(await page.getAttribute("#figures img", "alt"), "profile.svg");
  assert.ok(await page.evaluate(() => document.querySelector("#figures img").naturalWidth > 100), "no picture");
  assert.equal(await page.getAttribute("#design", "max"), String(history.length - 1), "initial, iterates, designed");
  await page.focus("#design");
  await page.keyboard.press("Home");
  assert.match(await label(), /^initial, stretch at 0°: \+43\.33 %$/);
  assert.equal(await page.getAttribute("#design", "aria-valuetext"), "initial");
  assert.ok(difference(await picture(), designed) > 1e-3, "the design looks as it began");
  await page.keyboard.press("ArrowRight");
  assert.equal(await label(), `iterate ${history[1].iteration}, at rest`);
  await page.click("#evolve");
  await page.waitForFunction((last) => document.getElementById("design").value === last, String(history.length - 1));
  assert.match(await label(), /^designed, at rest$/);

  // Bounds point to what is allowed, targets are crosses.
  const bounded = write("bounded", {
    name: "bounded", task: "design", length_unit: "mm", cell: { weave: { name: "european_4in1" } },
    load_case: { plugin: "in_plane_periodic", senses: ["stretch"] }, solver: { starts: 1, neighbours: 0 },
    design: { optimizer: { plugin: "sqp", max_iterations: 1 }, quantity: "stretch", tolerance: 0.9, starts: 1,
      variables: [{ parameters: "ring.r0", lower: 0.3, upper: 2 }],
      targets: [{ direction_deg: 0, value: 0.1, aim: "no_further" },
        { direction_deg: 60, value: 0.05, aim: "no_nearer" }, { direction_deg: 120, value: 0.12 }] },
  });
  run("export", bounded, "-o", join(bounded, "page.html"));
  await page.goto(`file://${join(bounded, "page.html")}`);
  await page.waitForFunction(() => Number(document.documentElement.dataset.frames) > 0);
  assert.equal(await page.locator("#plot .target").count(), 6);
  const bounds = await page.evaluate(() => [...document.querySelectorAll("#plot .target[d$=Z]")].map((one) => {
    const corners = one.getAttribute("d").match(/-?[\d.]+(e-\d+)?/g).map(Number);
    const away = [0, 2, 4].map((k) => Math.hypot(corners[k] - 100, corners[k + 1] - 100));
    return [one.textContent, away[2] > away[0]];
  }));
  assert.deepEqual(bounds.map((one) => one[0].replace(/[^a-z ]/g, "").trim()),
    ["no further than", "no further than", "no nearer than", "no nearer than"]);
  assert.deepEqual(bounds.map((one) => one[1]), [false, false, true, true]);
  assert.match(await page.getAttribute("#plot svg", "aria-label"), /targets as crosses, bounds as bars/);

  // A report of several, of which each is shown.
  const reported = join(folder, "reported");
  assert.match(run("report", sheet, made, rolled, "-o", reported), /report\.html$/m);
  await page.goto(`file://${join(reported, "report.html")}`);
  await page.waitForFunction(() => Number(document.documentElement.dataset.frames) > 0);
  assert.equal(await page.locator("#results tbody tr").count(), 3);
  assert.match(await page.textContent("#results tbody tr:nth-child(1) td:nth-child(2)"), /^\+.* to \+.* %$/);
  assert.equal(await page.textContent("#results tbody tr:nth-child(3) td:nth-child(2)"), "0.1972 /mm");
  assert.equal(await page.textContent("#results tbody tr:nth-child(3) button"), "@VIEWER@");
  assert.equal(await page.textContent("#title"), "</script><b>sheet");
  assert.ok(await page.isHidden("#designs"), "a sheet has no iterates");
  await page.click("#results tbody tr:nth-child(2) button");
  assert.equal(await page.textContent("#title"), "sqp_example");
  assert.equal(await page.getAttribute("#results tbody tr:nth-child(2)", "aria-selected"), "true");
  assert.ok(await page.isVisible("#design"));
  assert.equal(await page.locator("#limits tbody tr").count(), 1);
  await page.click("#results tbody tr:nth-child(1) button");
  assert.equal(await page.locator("#plot .mark").count(), 12);

  // An experiment alone is a page of one state.
  run("export", join(checkout, "share/experiments/hook_and_eye.json"), "-o", join(folder, "one.html"));
  await page.goto(`file://${join(folder, "one.html")}`);
  await page.waitForFunction(() => Number(document.documentElement.dataset.frames) > 0);
  assert.equal(await label(), "at rest");
  assert.ok(await page.isDisabled("#motion"));
  assert.deepEqual(wrong, []);
} finally {
  await browser.close();
  rmSync(folder, { recursive: true });
}
