// Makes the pictures of a report comparable: side by side, wiped, blinked, subtracted; zoomed to the
// pixel. Without it the page shows the same pictures one beside the other.
"use strict";

(() => {
  const kModes = [
    ["side", "Side by side"],
    ["wipe", "Wipe"],
    ["blink", "Blink"],
    ["difference", "Difference"],
  ];
  const kBlinkMs = 600;
  const kMarkZoom = 12; // screen pixels a picture's pixel, when a place is shown
  const kLargestZoom = 64;

  const make = (tag, properties = {}, children = []) => {
    const node = document.createElement(tag);
    for (const [name, value] of Object.entries(properties)) {
      if (name in node) node[name] = value;
      else node.setAttribute(name, value);
    }
    node.append(...children);
    return node;
  };
  const clamp = (value, low, high) => Math.min(Math.max(value, low), high);

  class Viewer {
    constructor(section) {
      this.section = section;
      this.width = Number(section.dataset.width);
      this.height = Number(section.dataset.height);
      this.pictures = [...section.querySelectorAll("img.pixels")];
      this.a = 0;
      this.b = Math.min(1, this.pictures.length - 1);
      this.mode = this.pictures.length > 1 ? "side" : "blink";
      this.wipe = 0.5;
      this.gain = 1;
      this.showsB = false;
      this.blinks = true;
      this.zoom = 0; // 0: as large as fits
      this.x = this.width / 2;
      this.y = this.height / 2;
      this.marked = null;
      this.build();
      this.arrange();
      section.classList.add("live");
      this.place();
      new ResizeObserver(() => this.place()).observe(this.stage);
    }

    // The controls, once.
    build() {
      this.modeButtons = kModes.map(([mode, label]) =>
        make("button", { type: "button", textContent: label, onclick: () => this.setMode(mode) }),
      );
      const choose = (label, which) => {
        const list = make("select", {
          onchange: () => {
            this[which] = Number(list.value);
            this.arrange();
            this.place();
          },
        });
        this.pictures.forEach((picture, i) =>
          list.append(make("option", { value: String(i), textContent: picture.dataset.name })),
        );
        list.value = String(this[which]);
        return make("label", {}, [label + " ", list]);
      };
      const zoomButton = (label, title, act) =>
        make("button", { type: "button", textContent: label, title, "aria-label": title, onclick: act });
      this.wipeInput = make("input", { type: "range", min: "0", max: "100", value: "50" });
      this.wipeInput.oninput = () => {
        this.wipe = Number(this.wipeInput.value) / 100;
        this.place();
      };
      this.gainInput = make("input", { type: "range", min: "0", max: "6", step: "1", value: "0" });
      this.gainInput.oninput = () => {
        this.gain = 2 ** Number(this.gainInput.value);
        this.gainText.textContent = ` \u00d7${this.gain}`;
        this.place();
      };
      this.gainText = make("span", { textContent: " \u00d71" });
      this.flip = make("button", { type: "button", textContent: "Swap", onclick: () => this.swap() });
      this.wipeLabel = make("label", {}, ["Edge ", this.wipeInput]);
      this.gainLabel = make("label", {}, ["Gain ", this.gainInput, this.gainText]);
      this.readout = make("output", { className: "place", "aria-live": "polite" });
      const toolbar = make("div", { className: "toolbar", role: "toolbar", "aria-label": "Picture controls" }, [
        make("span", { className: "group", role: "group", "aria-label": "Way of comparing" }, this.modeButtons),
        choose("A", "a"),
        choose("B", "b"),
        make("span", { className: "group", role: "group", "aria-label": "Zoom" }, [
          zoomButton("\u2212", "Zoom out", () => this.zoomBy(0.5)),
          zoomButton("+", "Zoom in", () => this.zoomBy(2)),
          zoomButton("1:1", "One screen pixel a pixel", () => this.zoomTo(1)),
          zoomButton("Fit", "Show the whole picture", () => this.fit()),
        ]),
        this.wipeLabel,
        this.gainLabel,
        this.flip,
        this.readout,
      ]);
      this.stage = make("div", {
        className: "stage",
        tabIndex: 0,
        role: "group",
        "aria-label": "Pictures; arrow keys move, plus and minus zoom, 0 fits, space swaps",
      });
      this.captions = make("div", { className: "captions" });
      this.section.append(
        make("div", { className: "interactive" }, [toolbar, this.stage, this.captions]),
      );
      this.listen();
    }

    listen() {
      this.stage.addEventListener("keydown", (event) => this.key(event));
      this.stage.addEventListener(
        "wheel",
        (event) => {
          if (!event.ctrlKey && document.activeElement !== this.stage) return;
          event.preventDefault();
          this.zoomBy(event.deltaY < 0 ? 1.25 : 0.8, this.pointed(event));
        },
        { passive: false },
      );
      this.stage.addEventListener("pointerdown", (event) => {
        if (!event.target.closest(".pane")) return;
        this.grip = { x: event.clientX, y: event.clientY };
        this.stage.setPointerCapture(event.pointerId);
      });
      this.stage.addEventListener("pointermove", (event) => {
        if (this.grip) {
          const scale = this.scale();
          this.move((this.grip.x - event.clientX) / scale, (this.grip.y - event.clientY) / scale);
          this.grip = { x: event.clientX, y: event.clientY };
        }
        this.say(this.pointed(event));
      });
      for (const end of ["pointerup", "pointercancel"]) {
        this.stage.addEventListener(end, () => (this.grip = null));
      }
      if (!matchMedia("(prefers-reduced-motion: reduce)").matches) {
        setInterval(() => this.mode === "blink" && this.blinks && !document.hidden && this.toggle(), kBlinkMs);
      }
    }

    key(event) {
      const step = 60 / this.scale();
      const acts = {
        ArrowLeft: () => this.move(-step, 0),
        ArrowRight: () => this.move(step, 0),
        ArrowUp: () => this.move(0, -step),
        ArrowDown: () => this.move(0, step),
        "+": () => this.zoomBy(2),
        "=": () => this.zoomBy(2),
        "-": () => this.zoomBy(0.5),
        0: () => this.fit(),
        " ": () => this.swap(),
      };
      const act = acts[event.key];
      if (!act || event.ctrlKey || event.metaKey || event.altKey) return;
      event.preventDefault();
      act();
    }

    setMode(mode) {
      this.mode = mode;
      this.blinks = true;
      this.arrange();
      this.place();
    }

    // The panes and their layers, for each way of comparing and choice of pictures.
    arrange() {
      const layer = (picture, kind) =>
        make("div", { className: "layer " + kind }, [
          make("img", { src: picture.src, alt: picture.alt, draggable: false }),
        ]);
      const pane = (name, layers) => {
        const node = make("div", { className: "pane" }, [
          make("div", { className: "layer content" }, layers),
          make("span", { className: "name", textContent: name }),
        ]);
        node.style.aspectRatio = `${this.width} / ${this.height}`;
        return node;
      };
      const a = this.pictures[this.a];
      const b = this.pictures[this.b];
      const between = this.mode === "difference" ? "\u2212" : "|";
      const names = `${a.dataset.name} ${between} ${b.dataset.name}`;
      if (this.mode === "side") {
        this.panes = [pane(a.dataset.name, [layer(a, "under")]), pane(b.dataset.name, [layer(b, "under")])];
      } else {
        const over = this.mode === "difference" ? "over difference" : "over";
        this.panes = [pane(names, [layer(a, "under"), layer(b, over)])];
        if (this.mode === "wipe") this.panes[0].append(make("div", { className: "edge" }));
      }
      for (const node of this.panes) node.append(make("div", { className: "mark", hidden: true }));
      this.stage.replaceChildren(...this.panes);
      this.stage.classList.toggle("two", this.mode === "side");
      this.modeButtons.forEach((button, i) =>
        button.setAttribute("aria-pressed", String(kModes[i][0] === this.mode)),
      );
      this.wipeLabel.hidden = this.mode !== "wipe";
      this.gainLabel.hidden = this.mode !== "difference";
      this.flip.hidden = this.mode !== "blink";
      this.captions.replaceChildren(
        ...[a, b].map((picture) => {
          const figure = picture.parentElement;
          const copy = make("div");
          for (const part of figure.querySelectorAll(".legend, figcaption")) copy.append(part.cloneNode(true));
          return copy;
        }),
      );
    }

    // Screen pixels a picture's pixel.
    scale() {
      const pane = this.panes[0];
      if (this.zoom > 0) return this.zoom;
      return Math.min(pane.clientWidth / this.width, pane.clientHeight / this.height) || 1;
    }

    // Puts everything where the zoom, the place and the mode want it.
    place() {
      const scale = this.scale();
      for (const pane of this.panes) {
        const left = pane.clientWidth / 2 - this.x * scale;
        const top = pane.clientHeight / 2 - this.y * scale;
        for (const image of pane.querySelectorAll("img")) {
          image.style.transform = `translate(${left}px, ${top}px) scale(${scale})`;
          image.classList.toggle("near", scale > 1);
        }
        this.placeMark(pane, left, top, scale);
      }
      const [pane] = this.panes;
      const over = pane.querySelector(".over");
      if (this.mode === "wipe") {
        over.style.clipPath = `inset(0 0 0 ${100 * this.wipe}%)`;
        pane.querySelector(".edge").style.left = `calc(${100 * this.wipe}% - 1px)`;
      }
      if (this.mode === "blink") {
        over.style.visibility = this.showsB ? "visible" : "hidden";
        const shown = this.pictures[this.showsB ? this.b : this.a];
        pane.querySelector(".name").textContent = shown.dataset.name;
      }
      const bright = this.mode === "difference" && this.gain > 1;
      pane.querySelector(".content").style.filter = bright ? `brightness(${this.gain})` : "";
    }

    placeMark(pane, left, top, scale) {
      const mark = pane.querySelector(".mark");
      mark.hidden = !this.marked;
      if (!this.marked) return;
      const size = Math.max(scale, 14);
      const middle = (pixel, edge) => edge + (pixel + 0.5) * scale - size / 2;
      mark.style.left = `${middle(this.marked.x, left) - 2}px`;
      mark.style.top = `${middle(this.marked.y, top) - 2}px`;
      mark.style.width = mark.style.height = `${size + 4}px`;
    }

    // The pixel under the pointer.
    pointed(event) {
      for (const pane of this.panes) {
        const box = pane.getBoundingClientRect();
        const x = event.clientX - box.left;
        const y = event.clientY - box.top;
        if (x < 0 || y < 0 || x >= box.width || y >= box.height) continue;
        const scale = this.scale();
        return { x: this.x + (x - box.width / 2) / scale, y: this.y + (y - box.height / 2) / scale };
      }
      return null;
    }

    say(at) {
      if (!at) return;
      const x = Math.floor(at.x);
      const y = Math.floor(at.y);
      const inside = x >= 0 && y >= 0 && x < this.width && y < this.height;
      this.readout.textContent = inside ? `pixel ${x}, ${y} \u00b7 ${Math.round(100 * this.scale())} %` : "";
    }

    move(dx, dy) {
      this.x = clamp(this.x + dx, 0, this.width);
      this.y = clamp(this.y + dy, 0, this.height);
      this.place();
    }

    zoomTo(zoom, around = null) {
      const before = this.scale();
      this.zoom = clamp(zoom, 0.02, kLargestZoom);
      if (around) {
        const keep = before / this.zoom;
        this.x = around.x + (this.x - around.x) * keep;
        this.y = around.y + (this.y - around.y) * keep;
      }
      this.move(0, 0);
    }

    zoomBy(factor, around = null) {
      this.zoomTo(this.scale() * factor, around);
    }

    fit() {
      this.zoom = 0;
      this.x = this.width / 2;
      this.y = this.height / 2;
      this.place();
    }

    toggle() {
      this.showsB = !this.showsB;
      this.place();
    }

    // By hand, from whichever mode: the blinking stops until it is chosen again.
    swap() {
      if (this.mode !== "blink") this.setMode("blink");
      this.blinks = false;
      this.toggle();
    }

    show(x, y) {
      this.marked = { x, y };
      this.x = x + 0.5;
      this.y = y + 0.5;
      this.zoom = Math.max(this.scale(), kMarkZoom);
      this.place();
      this.say(this.marked);
      this.section.scrollIntoView({ block: "nearest" });
    }
  }

  const viewers = new Map();
  for (const section of document.querySelectorAll(".viewer")) {
    if (section.querySelector("img.pixels")) viewers.set(section.id, new Viewer(section));
  }
  for (const link of document.querySelectorAll("a[data-viewer]")) {
    link.addEventListener("click", (event) => {
      const viewer = viewers.get(link.dataset.viewer);
      if (!viewer) return;
      event.preventDefault();
      viewer.show(Number(link.dataset.x), Number(link.dataset.y));
    });
  }
})();
