// chart_test.mjs CHROMIUM WORK_FOLDER PAGE: opens the charts of a sweep in a real browser and uses them as a person would. What is drawn is
// counted against the page's own table. Screenshots stay in WORK_FOLDER.
import assert from "node:assert/strict";
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

import { Browser } from "./browser.mjs";
import { check, conclude, fail } from "./checks.mjs";

const [program, work, page] = process.argv.slice(2);
assert.ok(page, "usage: chart_test.mjs CHROMIUM WORK_FOLDER PAGE");
mkdirSync(work, { recursive: true });

const drawn = (tab) => tab.until(() => tab.evaluate(`document.querySelector("#charts")?.dataset.drawn === "all"`), "all charts are drawn");

// How many marks of a name a chart shows, in all its panels.
const marks = (tab, chart, name) =>
  tab.evaluate(`(() => {
    let count = 0;
    const visit = (group) => {
      for (const mark of group.items ?? []) {
        if (mark.name === ${JSON.stringify(name)}) count += mark.items.length;
        for (const item of mark.items ?? []) if (item.items) visit(item);
      }
    };
    visit(plumbViews[${JSON.stringify(chart)}].scenegraph().root.items[0]);
    return count;
  })()`);

// Runs of the page's table for which a condition holds, written with the names of its columns.
const runs = (tab, condition) =>
  tab.evaluate(`(() => {
    const { runs, series, cost } = JSON.parse(document.querySelector("#chart-table").textContent);
    return runs.series.filter((_, k) => {
      const of = (name) => runs[name][k];
      return ${condition};
    }).length;
  })()`);

const choose = (tab, label, value) =>
  tab.evaluate(`(() => {
    const select = [...document.querySelectorAll("label")].find((one) => one.textContent.startsWith(${JSON.stringify(label)})).querySelector("select");
    select.value = ${JSON.stringify(value)};
    select.onchange();
  })()`);

const kBoth = `of("error") !== null && of("draw_cpu_s") !== null`;

async function filters(tab) {
  await check("a terrain's runs alone are left by its filter", async () => {
    await choose(tab, "Terrain", "2");
    assert.equal(await marks(tab, "cost-error", "runPoints"), await runs(tab, `${kBoth} && of("terrain") === 2`));
    await choose(tab, "Terrain", "-1");
  });
  await check("a method's runs go with its box", async () => {
    const click = () => tab.evaluate(`document.querySelector(".chart-legend input[value='0']").click()`);
    await click();
    assert.equal(await marks(tab, "cost-error", "runPoints"), await runs(tab, `${kBoth} && of("series") !== 0`));
    assert.ok((await marks(tab, "cost-error", "front")) > 0, "the front stays");
    await click();
    assert.equal(await marks(tab, "cost-error", "runPoints"), await runs(tab, kBoth));
  });
  await check("another cost has its own runs", async () => {
    await choose(tab, "Cost", "triangles");
    const expected = await runs(tab, `of("error") !== null && of("triangles") !== null`);
    assert.ok(expected < (await runs(tab, kBoth)), "slices have no triangles");
    assert.equal(await marks(tab, "cost-error", "runPoints"), expected);
    await choose(tab, "Cost", "draw_cpu_s");
  });
  await check("a path at a tolerance has its frames", async () => {
    await choose(tab, "Path", "1");
    const asked = await tab.evaluate(`JSON.parse(document.querySelector("#chart-table").textContent).asked[2].value`);
    await choose(tab, "Tolerance asked", "2");
    const frames = await runs(tab, `${kBoth} && of("path") && of("terrain") === 1 && of("tolerance") === ${asked}`);
    assert.ok(frames > 0);
    assert.equal(await marks(tab, "path", "framePoints"), 3 * frames); // error, cost, popping
  });
}

async function tellsWhatAPointIs(tab) {
  const at = await tab.evaluate(`(() => {
    const holder = document.querySelector("#chart-cost-error");
    scrollTo(0, holder.getBoundingClientRect().top + scrollY - 300);
    const canvas = holder.querySelector("canvas").getBoundingClientRect();
    const view = plumbViews["cost-error"];
    let found = null;
    const visit = (group, x, y) => {
      for (const mark of group.items ?? []) {
        if (mark.name === "medianPoints" && mark.items.length) found = { x: x + mark.items.at(-1).x, y: y + mark.items.at(-1).y };
        for (const item of mark.items ?? []) if (item.items) visit(item, x + (item.x ?? 0), y + (item.y ?? 0));
      }
    };
    const [ox, oy] = view.origin();
    visit(view.scenegraph().root.items[0], ox, oy);
    return { x: canvas.x + found.x, y: canvas.y + found.y };
  })()`);
  await tab.send("Input.dispatchMouseEvent", { type: "mouseMoved", x: at.x, y: at.y });
  await tab.until(() => tab.evaluate(`!document.querySelector(".chart-bubble").hidden`), "the bubble shows");
  assert.match(await tab.evaluate(`document.querySelector(".chart-bubble").textContent`), /median of.*views/);
  await tab.evaluate(`plumbViews["cost-error"]; true`);
  await tab.click(at.x, at.y);
  await tab.until(() => tab.evaluate(`!document.querySelector(".chart-kept").hidden`), "a click keeps it");
}

const browser = new Browser(program, work);
try {
  const tab = await browser.open();
  await tab.resize(1280, 1000);
  await tab.go(pathToFileURL(page).href);
  await drawn(tab);
  const times = await tab.evaluate(`performance.getEntriesByType("mark").map((mark) => [mark.name, Math.round(mark.startTime)])`);
  console.log(`        ${times.map(([name, ms]) => `${name} after ${ms} ms`).join(", ")}`);
  await check("the first chart is there soon", async () => assert.ok(times[0][1] < 10_000, `${times[0][1]} ms`));
  await check("every finished run is a point", async () => {
    const all = await runs(tab, kBoth);
    assert.ok(all > 4500, `${all} runs`);
    assert.equal(await marks(tab, "cost-error", "runPoints"), all);
  });
  await check("exact and infinite runs are among them", async () => {
    assert.ok((await runs(tab, `of("error") === 0`)) > 0);
    assert.ok((await runs(tab, `of("error") === "inf"`)) > 0);
    assert.ok(await tab.evaluate(`plumbViews["cost-error"].data("runs").every(({ x, y }) => Number.isFinite(x) && Number.isFinite(y))`));
  });
  await check("every claim is a point", async () => {
    const claims = await tab.evaluate(`JSON.parse(document.querySelector("#chart-table").textContent).claims.run.length`);
    assert.equal(await marks(tab, "claims", "claimPoints"), claims);
  });
  await check("every kind has a winner's cell for each error", async () => assert.equal(await marks(tab, "winners", "cells"), 4 * 7));
  await filters(tab);
  await check("a point says what it is, and a click keeps that", () => tellsWhatAPointIs(tab));
  for (const [width, scheme] of [[1280, "light"], [1280, "dark"], [600, "light"]]) {
    await check(`fits ${width} pixels, ${scheme}`, async () => {
      await tab.resize(width, 1000, scheme);
      await new Promise((done) => setTimeout(done, 400));
      await drawn(tab);
      assert.ok((await tab.evaluate("document.documentElement.scrollWidth")) <= width, "no scrolling sideways");
      writeFileSync(join(work, `charts-${width}-${scheme}.png`), await tab.screenshot());
    });
  }
  await check("no request leaves the page", async () => assert.deepEqual(tab.requests.filter((url) => !/^(file|data):/.test(url)), []));
  await check("no error in the console", async () => assert.deepEqual(tab.faults, []));
} catch (error) {
  fail(error.message);
} finally {
  await browser.close();
}
conclude();
