// A headless Chromium, spoken to over a pipe in its DevTools protocol: one JSON object a message, a zero byte behind it.
import { spawn } from "node:child_process";
import { mkdirSync, rmSync } from "node:fs";
import { join } from "node:path";

const kAnswerMs = 120_000; // long: the machine may be busy with other tests

const kFlags = [
  "--headless=new",
  "--remote-debugging-pipe",
  "--no-sandbox", // tests may run as root, where there is none
  "--disable-gpu",
  "--disable-dev-shm-usage",
  "--disable-background-networking",
  "--disable-component-update",
  "--disable-default-apps",
  "--disable-extensions",
  "--disable-sync",
  "--no-default-browser-check",
  "--no-first-run",
  "--no-proxy-server",
  "--host-resolver-rules=MAP * ~NOTFOUND", // no name leads anywhere
  "--hide-scrollbars",
  "--force-device-scale-factor=1",
  "--password-store=basic",
  "--use-mock-keychain",
];

export class Browser {
  // Starts `program` with a home of its own in `folder`, which is emptied.
  constructor(program, folder) {
    const home = join(folder, "chromium");
    rmSync(home, { recursive: true, force: true });
    mkdirSync(home, { recursive: true });
    const environment = { ...process.env, HOME: home, XDG_CONFIG_HOME: home, XDG_CACHE_HOME: home };
    this.process = spawn(program, [...kFlags, `--user-data-dir=${home}`, "about:blank"], {
      stdio: ["ignore", "ignore", "pipe", "pipe", "pipe"],
      env: environment,
    });
    this.complaints = "";
    this.process.stderr.on("data", (text) => (this.complaints = (this.complaints + text).slice(-4000)));
    this.waiting = new Map();
    this.listeners = [];
    this.last = 0;
    this.rest = "";
    const input = this.process.stdio[4];
    input.setEncoding("utf8");
    input.on("data", (text) => this.receive(text));
    this.process.stdio[3].on("error", () => {}); // said by `exit`
    this.ended = new Promise((resolve) => this.process.once("close", resolve));
    this.process.once("error", (error) => this.abandon(error.message));
    this.process.once("close", (status) => this.abandon(`Chromium ended with ${status}\n${this.complaints}`));
  }

  receive(text) {
    const messages = (this.rest + text).split("\0");
    this.rest = messages.pop();
    for (const message of messages.map((one) => JSON.parse(one))) {
      const waiting = this.waiting.get(message.id);
      if (!waiting) {
        for (const listener of this.listeners) listener(message);
        continue;
      }
      this.waiting.delete(message.id);
      clearTimeout(waiting.timer);
      if (message.error) waiting.reject(new Error(`${waiting.method}: ${message.error.message}`));
      else waiting.resolve(message.result);
    }
  }

  abandon(why) {
    for (const { reject, timer, method } of this.waiting.values()) {
      clearTimeout(timer);
      reject(new Error(`${method}: ${why}`));
    }
    this.waiting.clear();
  }

  send(method, params = {}, sessionId = undefined) {
    const id = ++this.last;
    return new Promise((resolve, reject) => {
      const timer = setTimeout(() => {
        this.waiting.delete(id);
        reject(new Error(`${method}: no answer in ${kAnswerMs / 1000} s\n${this.complaints}`));
      }, kAnswerMs);
      this.waiting.set(id, { resolve, reject, timer, method });
      this.process.stdio[3].write(JSON.stringify({ id, method, params, sessionId }) + "\0");
    });
  }

  // A fresh tab.
  async open() {
    const { targetId } = await this.send("Target.createTarget", { url: "about:blank" });
    const { sessionId } = await this.send("Target.attachToTarget", { targetId, flatten: true });
    const tab = new Tab(this, sessionId, targetId);
    await tab.begin();
    return tab;
  }

  async close() {
    await this.send("Browser.close").catch(() => {});
    const late = setTimeout(() => this.process.kill("SIGKILL"), 20_000);
    await this.ended;
    clearTimeout(late);
  }
}

class Tab {
  constructor(browser, session, target) {
    Object.assign(this, { browser, session, target });
    this.faults = []; // errors and exceptions of the console
    this.requests = []; // addresses
    browser.listeners.push((message) => message.sessionId === session && this.hear(message));
  }

  hear({ method, params }) {
    if (method === "Network.requestWillBeSent") this.requests.push(params.request.url);
    if (method === "Runtime.exceptionThrown")
      this.faults.push(params.exceptionDetails.exception?.description ?? params.exceptionDetails.text);
    if (method === "Runtime.consoleAPICalled" && ["error", "warning", "assert"].includes(params.type))
      this.faults.push(params.args.map((arg) => arg.value ?? arg.description).join(" "));
    if (method === "Log.entryAdded" && ["error", "warning"].includes(params.entry.level))
      this.faults.push(`${params.entry.text} ${params.entry.url ?? ""}`);
  }

  send(method, params = {}) {
    return this.browser.send(method, params, this.session);
  }

  async begin() {
    for (const domain of ["Page", "Runtime", "Log", "Network"]) await this.send(`${domain}.enable`);
  }

  async resize(width, height, scheme = "light") {
    await this.send("Emulation.setDeviceMetricsOverride", { width, height, deviceScaleFactor: 1, mobile: false });
    await this.send("Emulation.setEmulatedMedia", { features: [{ name: "prefers-color-scheme", value: scheme }] });
  }

  go(url) {
    return this.leadsTo(url, () => this.send("Page.navigate", { url }));
  }

  // Does what opens another page, and waits for it; what is asked of the old one in between has no answer.
  async leadsTo(url, act) {
    await act();
    const arrived = () =>
      this.evaluate(`document.readyState === "complete" && location.href === ${JSON.stringify(url)}`).catch(() => false);
    await this.until(arrived, `${url} is loaded`);
    await this.frame();
  }

  async evaluate(expression) {
    const { result, exceptionDetails } = await this.send("Runtime.evaluate", {
      expression,
      returnByValue: true,
      awaitPromise: true,
    });
    if (exceptionDetails) throw new Error(`${expression}: ${exceptionDetails.exception?.description}`);
    return result.value;
  }

  // Waits for the page to have drawn what it was told.
  frame() {
    return this.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(true))))");
  }

  async until(holds, what) {
    for (const end = Date.now() + kAnswerMs; Date.now() < end; ) {
      if (await holds()) return;
      await new Promise((resolve) => setTimeout(resolve, 50));
    }
    throw new Error(`not in ${kAnswerMs / 1000} s: ${what}`);
  }

  async click(x, y) {
    const at = { x, y, button: "left", clickCount: 1 };
    await this.send("Input.dispatchMouseEvent", { ...at, type: "mousePressed" });
    await this.send("Input.dispatchMouseEvent", { ...at, type: "mouseReleased" });
  }

  async press(key, text = undefined) {
    await this.send("Input.dispatchKeyEvent", { type: "keyDown", key, text });
    await this.send("Input.dispatchKeyEvent", { type: "keyUp", key });
  }

  // A PNG's bytes; of the whole page, or of a rectangle {x, y, width, height} of it.
  async screenshot(clip = undefined) {
    const { data } = await this.send("Page.captureScreenshot", {
      format: "png",
      captureBeyondViewport: true,
      clip: clip && { ...clip, scale: 1 },
    });
    return Buffer.from(data, "base64");
  }

  async close() {
    await this.browser.send("Target.closeTarget", { targetId: this.target });
  }
}
