// Sizes and speed of pages in headless Chromium without a graphics card.
//
//   node share/bench/pages.mjs HAUBERK
//
// Seven fabrics are computed and exported as pages with triangles within 0.1 mm of the surfaces; each is opened in a new
// browser. Prints a row for each: elements, size, seconds until the first picture is there, and pictures a second while
// the view turns. Needs Chromium, and share/setup.sh --viewer.
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const hauberk = process.argv[2] && resolve(process.argv[2]);
const root = resolve(dirname(fileURLToPath(import.meta.url)), "../..");
const playwright = join(root, "share/web/node_modules/playwright-core/index.mjs");
const chromium = ["/usr/bin/chromium", "/usr/bin/chromium-browser"].find(existsSync);
if (!hauberk || !existsSync(hauberk) || !existsSync(playwright) || !chromium) {
  console.error("share/bench/pages.mjs HAUBERK: needs the program, Chromium, and share/setup.sh --viewer");
  process.exit(2);
}
const { chromium: browsers } = await import(playwright);
const folder = mkdtempSync(join(tmpdir(), "hauberk-pages-"));

const mail = { name: "mail", task: "limits", length_unit: "mm", cell: { weave: { name: "european_4in1" } },
  load_case: { plugin: "in_plane_periodic", directions_deg: [0, 30, 60, 90, 120, 150], senses: ["stretch"] } };
const file = (name) => join(root, "share/experiments", `${name}.json`);
const fabrics = [
  ["chain", file("chain")], ["rolled patch", file("roll")], ["cubes of struts", file("cubes")],
  ["threefold", file("threefold_limits")], ["fourfold", file("fourfold_limits")],
  ["4-in-1 sheet", mail, "6,8"], ["4-in-1 sheet", mail, "22,24"],
];

async function measured(page) {
  const browser = await browsers.launch({ executablePath: chromium,
    args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--no-first-run"] });
  try {
    const view = await browser.newPage({ viewport: { width: 1000, height: 640 } });
    const begin = performance.now();
    await view.goto(`file://${page}`);
    await view.waitForFunction(() => Number(document.documentElement.dataset.frames) > 0);
    const first = (performance.now() - begin) / 1000;
    const rate = await view.evaluate(async () => {
      const frames = () => Number(document.documentElement.dataset.frames);
      const from = frames(), start = performance.now();
      while (performance.now() - start < 5000) {
        window.dispatchEvent(new Event("resize"));  // asks for a picture
        await new Promise(requestAnimationFrame);
      }
      return (frames() - from) / ((performance.now() - start) / 1000);
    });
    return { first, rate };
  } finally {
    await browser.close();
  }
}

try {
  console.log("| fabric | elements | size | first picture | pictures a second |\n| --- | --- | --- | --- | --- |");
  for (const [k, [name, what, repeat]] of fabrics.entries()) {
    let source = what;
    if (typeof what !== "string") {
      source = join(folder, `${k}.json`);
      writeFileSync(source, JSON.stringify(what));
    }
    const out = join(folder, `${k}`), page = join(folder, `${k}.html`);
    execFileSync(hauberk, ["run", source, "-o", out, "--quiet", "--yes"], { encoding: "utf8" });
    const said = execFileSync(hauberk, ["export", out, "-o", page, "--chord", "0.1", ...(repeat ? ["--repeat", repeat] : [])],
      { encoding: "utf8" });
    const elements = /(\d+) elements/.exec(said)[1];
    const { first, rate } = await measured(page);
    console.log(`| ${name} | ${elements} | ${(statSync(page).size / 1e6).toFixed(1)} MB | ${first.toFixed(1)} s | ${rate.toFixed(rate < 10 ? 1 : 0)} |`);
  }
} finally {
  rmSync(folder, { recursive: true, force: true });
}
