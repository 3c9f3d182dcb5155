// node chart-print.js VEGA CHART_DATA JOB: draws charts for print. JOB is a JSON file: `table` as the page has it, and `charts`, a list of
// {template, state, svg}: the file `svg` is written beside JOB.
"use strict";

const { readFileSync, writeFileSync } = require("node:fs");
const { dirname, join, resolve } = require("node:path");

const [vegaFile, dataFile, jobFile] = process.argv.slice(2).map((name) => resolve(name));
const vega = require(vegaFile);
const plumbCharts = require(dataFile);
const job = JSON.parse(readFileSync(jobFile, "utf8"));

(async () => {
  for (const { template, state, svg } of job.charts) {
    const spec = plumbCharts.fill(template, job.table, state);
    const view = new vega.View(vega.parse(spec), { renderer: "none", logLevel: vega.Error });
    await view.runAsync();
    writeFileSync(join(dirname(jobFile), svg), (await view.toSVG()) + "\n");
    view.finalize();
  }
})().catch((error) => {
  console.error(error.message);
  process.exitCode = 1;
});
