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

  const terrains = (table) =>
    table.terrains.map(({ name, kind }, terrain) => ({ terrain, name, kind, title: kind && kind !== name ? `${name} (${kind})` : name }));

  const command = (table, run) => table.runs.command[run].map((word) => table.words[word]).join(" ");

  // The data of every template, by the name that it has there.
  const sources = {
    runTable: runs,
    settingTable: settings,
    terrainTable: terrains,
    seriesTable: (table, look) =>
      table.series.map((one, series) => ({ ...one, series, fill: one.filled ? one.colour : look.paper, dashes: dashes(one) })),
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
      ...state,
    };
    for (const signal of spec.signals) if (signal.name in values && !("update" in signal)) signal.value = values[signal.name];
    for (const data of spec.data) if (data.name in sources) data.values = sources[data.name](table, values);
    return spec;
  }

  return { fill, runs, settings, terrains, command, finite };
})();

if (typeof module !== "undefined") module.exports = plumbCharts;
