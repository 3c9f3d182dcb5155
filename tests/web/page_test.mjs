// page_test.mjs CHROMIUM WORK_FOLDER INDEX_PAGE PAGE...: opens reports in a real browser and uses them as a person would.
// Screenshots, at two widths, light and dark, stay in WORK_FOLDER.
import assert from "node:assert/strict";
import { mkdirSync, writeFileSync } from "node:fs";
import { basename, dirname, join } from "node:path";
import { pathToFileURL } from "node:url";

import { Browser } from "./browser.mjs";
import { check, conclude, fail } from "./checks.mjs";

const [program, work, index, ...pages] = process.argv.slice(2);
assert.ok(pages.length > 0, "usage: page_test.mjs CHROMIUM WORK_FOLDER INDEX_PAGE PAGE...");
mkdirSync(work, { recursive: true });

// The part of the page that an element covers, and whether it can be seen; scrolls it into view.
const box = (tab, selector) =>
  tab.evaluate(`(() => {
    const node = document.querySelector(${JSON.stringify(selector)});
    if (!node) return null;
    node.scrollIntoView({ block: "center" });
    const { x, y, width, height } = node.getBoundingClientRect();
    const style = getComputedStyle(node);
    return { x, y, width, height, seen: width > 0 && height > 0 && style.visibility === "visible" && style.opacity !== "0" };
  })()`);

async function mode(tab, label) {
  const found = await tab.evaluate(`(() => {
    const button = [...document.querySelectorAll(".toolbar button")].find((one) => one.textContent === ${JSON.stringify(label)});
    button?.click();
    return button?.getAttribute("aria-pressed");
  })()`);
  assert.equal(found, "true", `there is a button '${label}' that is pressed then`);
  await tab.frame();
}

const choose = (tab, which, name) =>
  tab.evaluate(`(() => {
    const list = document.querySelectorAll(".toolbar select")[${which}];
    const option = [...list.options].find((one) => one.textContent === ${JSON.stringify(name)});
    if (!option) return false;
    list.value = option.value;
    list.dispatchEvent(new Event("change"));
    return true;
  })()`);

async function stage(tab) {
  const { x, y, width, height } = await box(tab, ".stage");
  const top = await tab.evaluate("window.scrollY");
  return tab.screenshot({ x, y: y + top, width, height });
}

async function moves_the_slider(tab) {
  await mode(tab, "Wipe");
  const clip = () => tab.evaluate(`document.querySelector(".pane .over").style.clipPath`);
  const before = { clip: await clip(), picture: await stage(tab) };
  const slider = await box(tab, ".toolbar input[type=range]");
  assert.ok(slider.seen, "the slider can be seen");
  await tab.click(slider.x + 0.15 * slider.width, slider.y + 0.5 * slider.height);
  await tab.until(async () => (await clip()) !== before.clip, "the edge has moved");
  await tab.frame();
  assert.ok(Number(await tab.evaluate(`document.querySelector(".toolbar input[type=range]").value`)) < 30);
  assert.notDeepEqual(await stage(tab), before.picture, "the picture has changed");
}

async function swaps(tab) {
  await mode(tab, "Blink");
  const name = () => tab.evaluate(`document.querySelector(".pane .name").textContent`);
  await tab.evaluate(`[...document.querySelectorAll(".toolbar button")].find((one) => one.textContent === "Swap").click()`);
  const first = await name();
  await new Promise((resolve) => setTimeout(resolve, 1500));
  assert.equal(await name(), first, "once swapped by hand it blinks no more");
  await tab.evaluate(`document.querySelector(".stage").focus()`);
  await tab.press(" ", " ");
  await tab.until(async () => (await name()) !== first, "the space bar swaps");
  await mode(tab, "Side by side");
  await tab.evaluate(`document.querySelector(".stage").focus()`);
  await tab.press(" ", " ");
  await tab.until(() => tab.evaluate(`document.querySelectorAll(".pane").length === 1`), "it swaps from any mode");
}

async function shows_the_legend(tab, name) {
  await mode(tab, "Side by side");
  const map = await tab.evaluate(`document.querySelector(".figures .legend").parentElement.querySelector("img").dataset.name`);
  assert.ok(await choose(tab, 1, map), `${map} can be chosen`);
  await tab.frame();
  const legend = await box(tab, ".captions .legend");
  assert.ok(legend?.seen, "the legend can be seen");
  assert.ok(legend.width >= 100 && legend.height >= 20, `it is large enough: ${legend.width} x ${legend.height}`);
  assert.ok(await tab.evaluate(`document.querySelector(".captions .legend").naturalWidth > 0`), "it is a picture");
  writeFileSync(join(work, `${name}-legend.png`), await tab.screenshot());
}

async function jumps_to_an_offender(tab, name) {
  const link = await tab.evaluate(`(() => {
    const link = document.querySelector("a[data-viewer]");
    return link && { x: Number(link.dataset.x), y: Number(link.dataset.y) };
  })()`);
  assert.ok(link, "there is a link to a pixel");
  const hidden = () => tab.evaluate(`document.querySelector(".pane .mark").hidden`);
  assert.ok(await hidden(), "no pixel is marked before");
  const at = await box(tab, "a[data-viewer]");
  await tab.click(at.x + at.width / 2, at.y + at.height / 2);
  await tab.until(async () => !(await hidden()), "the pixel is marked");
  await tab.frame();
  const said = await tab.evaluate(`document.querySelector(".place").textContent`);
  assert.ok(said.startsWith(`pixel ${link.x}, ${link.y} `), `the viewer says where: '${said}'`);
  const zoom = await tab.evaluate(`(() => {
    const image = document.querySelector(".pane img");
    return image.getBoundingClientRect().width / Number(image.closest(".viewer").dataset.width);
  })()`);
  assert.ok(zoom >= 12, `it is magnified: ${zoom} times`);
  const seen = await tab.evaluate(`(() => {
    const mark = document.querySelector(".pane .mark").getBoundingClientRect();
    const pane = document.querySelector(".pane").getBoundingClientRect();
    return mark.width > 0 && mark.left >= pane.left && mark.right <= pane.right && mark.bottom <= innerHeight && mark.top >= 0;
  })()`);
  assert.ok(seen, "the mark lies in the picture and in the window");
  writeFileSync(join(work, `${name}-jump.png`), await tab.screenshot());
}

async function draws_every_picture(tab) {
  const empty = await tab.evaluate(`(async () => {
    await Promise.all([...document.images].map((image) => image.decode().catch(() => {})));
    return [...document.images].filter((image) => !(image.naturalWidth > 0)).map((image) => image.alt);
  })()`);
  assert.deepEqual(empty, []);
}

async function fits(tab, width) {
  const wide = await tab.evaluate("document.documentElement.scrollWidth");
  assert.ok(wide <= width, `nothing sticks out at ${width} px: ${wide}`);
}

async function asks_nobody(tab) {
  const foreign = tab.requests.filter((url) => !/^(file|data|blob|about):/.test(url));
  assert.deepEqual(foreign, []);
  const files = tab.requests.filter((url) => url.startsWith("file:") && !/\.html(#.*)?$/.test(url));
  assert.deepEqual(files, [], "a page needs no other file");
}

// Photographs for people: the whole page as it opens.
async function photographs(tab, name) {
  for (const [width, scheme] of [[1280, "light"], [1280, "dark"], [600, "light"], [600, "dark"]]) {
    await tab.resize(width, 900, scheme);
    await tab.frame();
    await fits(tab, width);
    writeFileSync(join(work, `${name}-${width}-${scheme}.png`), await tab.screenshot());
  }
  await tab.resize(1280, 900);
}

async function whole_page(browser, page) {
  const name = `${basename(dirname(page))}`;
  const tab = await browser.open();
  await tab.resize(1280, 900);
  await tab.go(pathToFileURL(page).href);
  await check(`${name}: every picture is drawn`, () => draws_every_picture(tab));
  await check(`${name}: fits wide and narrow windows`, () => photographs(tab, name));
  await check(`${name}: the slider moves the edge`, () => moves_the_slider(tab));
  await check(`${name}: pictures swap by button and key`, () => swaps(tab));
  await check(`${name}: a heat map has its legend`, () => shows_the_legend(tab, name));
  await check(`${name}: a link jumps to its pixel`, () => jumps_to_an_offender(tab, name));
  await check(`${name}: no request leaves the page`, () => asks_nobody(tab));
  await check(`${name}: no error in the console`, async () => assert.deepEqual(tab.faults, []));
  await tab.close();
}

async function index_page(browser) {
  const tab = await browser.open();
  await tab.resize(1280, 900);
  await tab.go(pathToFileURL(index).href);
  await check("index: every picture is drawn", () => draws_every_picture(tab));
  await check("index: fits wide and narrow windows", () => photographs(tab, "index"));
  await check("index: a row leads to its own page", async () => {
    const row = await box(tab, ".links a img");
    const url = await tab.evaluate(`document.querySelector(".links a").href`);
    await tab.leadsTo(url, () => tab.click(row.x + row.width / 2, row.y + row.height / 2));
    assert.ok(await tab.evaluate(`document.querySelector(".viewer.live") !== null`), "it has a viewer");
  });
  await check("index: no request leaves the page", () => asks_nobody(tab));
  await check("index: no error in the console", async () => assert.deepEqual(tab.faults, []));
  await tab.close();
}

const browser = new Browser(program, work);
try {
  await index_page(browser);
  for (const page of pages) await whole_page(browser, page);
} catch (error) {
  fail(error.message);
} finally {
  await browser.close();
}
conclude();
