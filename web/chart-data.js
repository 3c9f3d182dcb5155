// What the page and the maker of print files share: the table of a sweep as rows, and a chart's template with these in it.
"use strict";

const plumbCharts = (() => {
  const finite = (value) => (value === "inf" ? Infinity : value);

  // Columns {a: [..], b: [..]} as rows {a, b}.
  function rows(columns) {
    const names = Object.keys(columns);
    const count = names.length > 0 ? columns[names[0]].length : 0;
    const all = new Array(count);
    for (let k = 0; k < count; ++k) {
      const row = {};
      for (const name of names) row[name] = finite(columns[name][k]);
      all[k] = row;
    }
    return all;
  }

  const dashes = (series) => (series.dash ? series.dash.split(" ").map(Number) : [1, 0]);

  // How a series looks, on rows of its own.
  function look(row, table) {
    const { colour, shape, dash, filled } = table.series[row.series];
    return Object.assign(row, { colour, shape, dash, filled, dashes: dashes(table.series[row.series]) });
  }

  function runs(table) {
    const { command, verdict, ...columns } = table.runs;
    return rows(columns).map((row, run) => look(Object.assign(row, { run }), table));
  }

  const settings = (table) => rows(table.settings).map((row, setting) => look(Object.assign(row, { setting }), table));

  // Claims of whole frames, with what their runs are.
  function claims(table) {
    const { terrain, series } = table.runs;
    return rows(table.claims).map((row) => look(Object.assign(row, { terrain: terrain[row.run], series: series[row.run] }), table));
  }

  // Runs of camera paths: `on` is the path's row, `asked` that of the tolerance.
  function frames(table) {
    const path = new Map(table.paths.map(({ terrain, camera }, row) => [`${terrain} ${camera}`, row]));
    const asked = new Map(table.asked.map(({ value, unit }, row) => [`${value} ${unit}`, row]));
    return runs(table)
      .filter((run) => run.path && run.error !== null)
      .map((run) =>
        Object.assign(run, {
          on: path.get(`${run.terrain} ${run.camera}`),
          asked: asked.get(`${run.tolerance} ${table.series[run.series].unit}`),
        }),
      );
  }

  const quantities = (table) => [
    { quantity: "error", title: "Measured error, pixels" },
    { quantity: "cost", title: "" },
    ...(table.runs.popping.some((value) => value !== null)
      ? [{ quantity: "popping", title: "Popping: jump of the picture since the frame before, pixels" }]
      : []),
  ];

  const short = (value) => (value === Infinity ? "infinite" : String(Number(Number(value).toPrecision(3))));

  // A number with few characters: 12 300 000 is "12.3 M".
  function compact(value) {
    const [size, letter] = [[1e9, " G"], [1e6, " M"], [1e3, " k"]].find(([size]) => value >= size) ?? [1, ""];
    return short(value / size) + letter;
  }

  // Lines of at most so many characters, broken at spaces, or behind hyphens where a word is longer.
  function wrapped(text, most) {
    const lines = [];
    for (const word of text.split(" ").flatMap((one) => (one.length > most ? one.split(/(?<=-)/) : [one]))) {
      const last = lines.at(-1);
      const joint = last?.endsWith("-") ? "" : " ";
      if (last !== undefined && (last + joint + word).length <= most) lines[lines.length - 1] = last + joint + word;
      else lines.push(word);
    }
    return lines;
  }

  // What stands in a cell of the grid of winners.
  function words(row, table) {
    const kLine = 19; // as wide as a cell
    if (row.series < 0) return ["none kept it", "in all views"];
    const { name, unit } = table.series[row.series];
    const cost = table.costs.find(({ key }) => key === row.cost);
    const lines = [...wrapped(name, kLine), `asked ${short(row.tolerance)} ${unit}`, `${compact(row.value)} ${cost.unit}`.trim()];
    if (row.second >= 0 && row.times > 0) lines.push(row.times < 1.005 ? "hardly less than" : `${short(row.times)} × less than`, ...wrapped(table.series[row.second].name, kLine));
    return lines;
  }

  const winners = (table) =>
    table.winners.map((row) => ({
      ...row,
      column: table.limits.indexOf(row.limit),
      lines: words(row, table),
      ...(row.series < 0 ? { colour: "", shape: "circle", filled: true } : table.series[row.series]),
      series: row.series,
    }));

  const looks = (table, paper) => ({
    name: table.series.map((one) => one.name),
    colour: table.series.map((one) => one.colour),
    shape: table.series.map((one) => one.shape),
    fill: table.series.map((one) => (one.filled ? one.colour : paper)),
  });

  const terrains = (table) =>
    table.terrains.map(({ name, kind }, terrain) => ({ terrain, name, kind, title: kind && kind !== name ? `${name} (${kind})` : name }));

  const command = (table, run) => table.runs.command[run].map((word) => table.words[word]).join(" ");

  // The data of every template, by the name that it has there.
  const sources = {
    runTable: runs,
    frameTable: frames,
    settingTable: settings,
    terrainTable: terrains,
    claimTable: claims,
    quantityTable: quantities,
    winnerTable: winners,
    kindTable: (table) => table.kinds.map((kind, row) => ({ row, title: kind || "no kind" })),
    limitTable: (table) => table.limits.map((limit, row) => ({ row, title: `${limit} px` })),
  };

  const kLight = { ink: "#1b1d21", quiet: "#5b616b", faint: "#e3e5e8", paper: "#ffffff" };

  // A template with its data and the first values of its signals: those of `state` that it has.
  function fill(template, table, state) {
    const spec = structuredClone(template);
    const values = {
      ...kLight,
      terrain: -1,
      hidden: [],
      cost: table.cost,
      costs: Object.fromEntries(table.costs.map((cost) => [cost.key, cost])),
      xAxis: table.error,
      poppingAxis: table.popping,
      measure: 0,
      measures: table.measures,
      path: 0,
      paths: table.paths,
      asked: table.first_asked,
      askedTitles: table.asked.map(({ value, unit }) => `${value} ${unit}`),
      kinds: table.kinds,
      limits: table.limits,
      ...state,
    };
    values.looks = looks(table, values.paper);
    for (const signal of spec.signals) if (signal.name in values && !("update" in signal)) signal.value = values[signal.name];
    for (const data of spec.data) if (data.name in sources) data.values = sources[data.name](table);
    return spec;
  }

  return { fill, runs, settings, terrains, command, finite };
})();

if (typeof module !== "undefined") module.exports = plumbCharts;
