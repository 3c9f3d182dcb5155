// Makes the charts of a sweep live: draws them, filters, tells what a point is.
"use strict";

(() => {
  const section = document.querySelector("#charts");
  if (!section || typeof vega === "undefined") return;
  const read = (id) => JSON.parse(document.getElementById(id).textContent);
  const table = read("chart-table");
  const templates = read("chart-templates");
  const costs = Object.fromEntries(table.costs.map((cost) => [cost.key, cost]));
  const state = { terrain: -1, hidden: [], cost: table.cost, measure: 0, path: 0, asked: table.first_asked };
  const views = (window.plumbViews = {});

  const make = (tag, properties = {}, children = []) => {
    const node = document.createElement(tag);
    for (const [name, value] of Object.entries(properties)) {
      if (name in node) node[name] = value;
      else node.setAttribute(name, value);
    }
    node.append(...children);
    return node;
  };

  const short = (value) =>
    value === null || value === undefined ? "-" : value === Infinity ? "infinite" : String(Number(Number(value).toPrecision(4)));

  // ---- what a point is

  const bubble = make("div", { className: "chart-bubble", hidden: true });
  const kept = make("div", { className: "chart-kept", hidden: true });
  document.body.append(bubble, kept);

  const at = (columns, name, row) => plumbCharts.finite(columns[name][row]);

  function facts(number) {
    const of = number < 0 ? table.settings : table.runs;
    const row = number < 0 ? -1 - number : number;
    const series = table.series[of.series[row]];
    const lines = [
      ["terrain", table.terrains[of.terrain[row]].name],
      ["method", [series.method, series.variant].filter(Boolean).join(", ")],
      ["tolerance", `${short(at(of, "tolerance", row))} ${series.unit}`],
    ];
    if (series.parameters) lines.push(["parameters", series.parameters]);
    if (number < 0) lines.push(["median of", `${of.runs[row]} views`]);
    else {
      const frame = of.frame[row] > 0 ? `, frame ${of.frame[row]}` : "";
      lines.push(["view", table.cameras[of.camera[row]] + frame]);
      lines.push(["claims", { held: "held", broken: "broken" }[table.runs.verdict[row]] ?? "no verdict"]);
    }
    lines.push(["error", `${short(at(of, "error", row))} px`]);
    const cost = costs[state.cost];
    const shared = cost.time && of.shared[row] ? " (taken while sharing the machine)" : "";
    lines.push([cost.name, short(at(of, state.cost, row)) + shared]);
    if (number >= 0) lines.push(["command", plumbCharts.command(table, row)]);
    return lines;
  }

  const list = (number) =>
    make("dl", {}, facts(number).flatMap(([name, value]) => [make("dt", { textContent: name }), make("dd", { textContent: value })]));

  function tell(event, number) {
    bubble.hidden = number === null || number === undefined || number === "";
    if (bubble.hidden) return;
    bubble.replaceChildren(list(number));
    const { offsetWidth: width, offsetHeight: height } = bubble;
    bubble.style.left = `${Math.max(4, Math.min(event.clientX + 14, innerWidth - width - 4))}px`;
    bubble.style.top = `${event.clientY + 14 + height > innerHeight ? Math.max(4, event.clientY - height - 14) : event.clientY + 14}px`;
  }

  function keep(number) {
    kept.hidden = false;
    const close = make("button", { type: "button", textContent: "Close", onclick: () => (kept.hidden = true) });
    kept.replaceChildren(list(number), close);
  }

  // ---- drawing

  const dark = matchMedia("(prefers-color-scheme: dark)");
  const colours = () => {
    const style = getComputedStyle(document.documentElement);
    const of = (name) => style.getPropertyValue(name).trim();
    return { ink: of("--ink"), quiet: of("--quiet"), faint: of("--line"), paper: of("--card") };
  };

  const wide = (holder) => Math.max(320, Math.floor(holder.clientWidth) - 12);

  function draw(name) {
    const holder = document.getElementById(`chart-${name}`);
    if (!holder) return; // the results have nothing for it
    views[name]?.finalize();
    const spec = plumbCharts.fill(templates[name], table, { ...state, ...colours(), wide: wide(holder) });
    delete spec.legends; // the page's own is the filter
    const view = new vega.View(vega.parse(spec), { renderer: "canvas", container: holder, hover: true, logLevel: vega.Warn });
    view.tooltip((handler, event, item, value) => tell(event, value));
    view.addEventListener("click", (event, item) => {
      if (typeof item?.tooltip === "number") keep(item.tooltip);
    });
    view.run();
    performance.mark(`drawn ${name}`);
    views[name] = view;
  }

  // The first chart at once, the others one by one behind it, so that the page answers meanwhile.
  function drawAll() {
    const names = Object.keys(templates);
    const next = () => {
      if (names.length > 0) draw(names.shift());
      if (names.length > 0) setTimeout(next);
      else section.dataset.drawn = "all";
    };
    delete section.dataset.drawn;
    next();
  }

  function change(name, value) {
    state[name] = value;
    for (const view of Object.values(views)) {
      if (!(name in view.getState().signals)) continue;
      view.signal(name, value).run();
    }
    say();
  }

  // ---- the controls

  const choice = (label, options, value, onchange) => {
    const select = make("select", {}, options.map(([key, text]) => make("option", { value: key, textContent: text })));
    select.value = value;
    select.onchange = () => onchange(select.value);
    return make("label", {}, [label + " ", select]);
  };

  const kPaths = {
    circle: "M-4.5,0a4.5,4.5 0 1,0 9,0a4.5,4.5 0 1,0 -9,0Z",
    square: "M-4,-4h8v8h-8Z",
    "triangle-up": "M0,-5L5,4h-10Z",
    "triangle-down": "M0,5L5,-4h-10Z",
    "triangle-left": "M-5,0L4,-5v10Z",
    "triangle-right": "M5,0L-4,-5v10Z",
    diamond: "M0,-5.5L5,0L0,5.5L-5,0Z",
    cross: "M-1.7,-5h3.4v3.3h3.3v3.4h-3.3v3.3h-3.4v-3.3h-3.3v-3.4h3.3Z",
  };

  function swatch({ colour, shape, dash, filled }) {
    const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
    for (const [name, value] of [["width", 34], ["height", 14], ["viewBox", "-17 -7 34 14"], ["aria-hidden", "true"]]) svg.setAttribute(name, value);
    const add = (tag, attributes) => {
      const node = document.createElementNS(svg.namespaceURI, tag);
      for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, value);
      svg.append(node);
    };
    add("path", { d: "M-17,0H17", stroke: colour, "stroke-width": 1.6, "stroke-dasharray": dash });
    add("path", { d: kPaths[shape], fill: filled ? colour : "var(--card)", stroke: colour, "stroke-width": filled ? 0 : 2 });
    return svg;
  }

  function legend() {
    const boxes = table.series.map((series, number) => {
      const box = make("input", { type: "checkbox", checked: true, value: String(number) });
      box.onchange = () => change("hidden", boxes.map((one, k) => (one.checked ? -1 : k)).filter((k) => k >= 0));
      return box;
    });
    const every = (checked) => () => {
      for (const box of boxes) box.checked = checked;
      boxes[0].onchange();
    };
    const labels = table.series.map((series, number) => make("label", {}, [boxes[number], swatch(series), series.name]));
    return make("fieldset", { className: "chart-legend" }, [
      make("legend", { textContent: "Methods" }),
      make("button", { type: "button", textContent: "All", onclick: every(true) }),
      make("button", { type: "button", textContent: "None", onclick: every(false) }),
      ...labels,
    ]);
  }

  const status = make("p", { className: "chart-count", "aria-live": "polite" });

  // How many runs the filters leave, and why one may be missing.
  function say() {
    const { series, terrain, error, shared } = table.runs;
    const values = table.runs[state.cost];
    let shown = 0;
    let without = 0;
    let together = 0;
    for (let k = 0; k < series.length; ++k) {
      if ((state.terrain >= 0 && terrain[k] !== state.terrain) || state.hidden.includes(series[k])) continue;
      if (error[k] === null || values[k] === null) ++without;
      else {
        ++shown;
        together += shared[k];
      }
    }
    const cost = costs[state.cost];
    status.textContent =
      `${shown} of ${series.length} finished runs are shown.` +
      (without > 0 ? ` ${without} show nothing of the terrain or have no number for “${cost.name}” (slices have no triangles, for one).` : "") +
      (cost.time && together > 0
        ? ` ${together} of these times were taken while other runs used the machine (crosses): they say little; plumb sweep --time measures one run at a time.`
        : "");
  }

  function controls() {
    const terrains = plumbCharts.terrains(table).map(({ terrain, title }) => [String(terrain), title]);
    const bar = make("div", { className: "toolbar" }, [
      choice("Cost", table.costs.map((cost) => [cost.key, cost.name]), state.cost, (key) => change("cost", key)),
      choice("Terrain", [["-1", "all, one chart each"], ...terrains], "-1", (value) => change("terrain", Number(value))),
    ]);
    section.append(bar, legend(), status);
  }

  // The choices of one chart alone, above it.
  function above(name, ...choices) {
    document.getElementById(`chart-${name}`)?.before(make("div", { className: "toolbar" }, choices));
  }

  const numbered = (list, text) => list.map((one, row) => [String(row), text(one)]);

  function ownControls() {
    const measures = numbered(table.measures, ({ name, unit }) => `${name}, ${unit}`);
    above("claims", choice("Claim", measures, "0", (value) => change("measure", Number(value))));
    above(
      "path",
      choice("Path", numbered(table.paths, ({ title }) => title), "0", (value) => change("path", Number(value))),
      choice("Tolerance asked", numbered(table.asked, ({ value, unit }) => `${value} ${unit}`), String(state.asked), (value) =>
        change("asked", Number(value)),
      ),
    );
  }

  controls();
  ownControls();
  say();
  drawAll();
  dark.addEventListener("change", drawAll);
  let width = innerWidth;
  let waiting = 0;
  addEventListener("resize", () => {
    if (innerWidth === width) return;
    width = innerWidth;
    clearTimeout(waiting);
    waiting = setTimeout(drawAll, 150);
  });
})();
