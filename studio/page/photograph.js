// The photograph: the stone's outline on it, moved by hand or laid on by the program, and the comparison.

/** Rows of a rotation, as nine numbers. */
const product = (a, b) => [0, 1, 2].flatMap((r) => [0, 1, 2].map((c) => a[3 * r] * b[c] + a[3 * r + 1] * b[3 + c] + a[3 * r + 2] * b[6 + c]));
/** By the angle about x, y (right, down) or z (away). */
function rotation(axis, angle) {
  const c = Math.cos(angle), s = Math.sin(angle), turn = [1, 0, 0, 0, 1, 0, 0, 0, 1];
  const [i, j] = [(axis + 1) % 3, (axis + 2) % 3];
  turn[4 * i] = turn[4 * j] = c;
  turn[3 * i + j] = -s;
  turn[3 * j + i] = s;
  return turn;
}

/** Where a view (StoneView) shows the corners of a wire; as compare/pose/stone_view.cpp. */
function projected(wire, view) {
  const near = view.nearness, x = (view.at[0] - view.sight[0]) * near / view.scale, y = (view.at[1] - view.sight[1]) * near / view.scale;
  const c = 1 / Math.hypot(1, x, y), [dx, dy, share] = [x * c, y * c, 1 / (1 + c)];
  const turn = product([1 - share * dx * dx, -share * dx * dy, dx, -share * dx * dy, 1 - share * dy * dy, dy, -dx, -dy, c], view.turn);
  return wire.corners.map((p) => {
    const [right, down, away] = [0, 3, 6].map((r) => turn[r] * p[0] + turn[r + 1] * p[1] + turn[r + 2] * p[2]);
    return [0, 1].map((i) => view.sight[i] + (view.at[i] - view.sight[i] + view.scale * [right, down][i]) / (1 + near * away));
  });
}

/** Paths of the edges that are seen: of the outline, and between two facets that face the viewer. */
function wire_paths(wire, points) {
  const seen = new Map();
  for (const corners of wire.facets) {
    const area = corners.reduce((sum, a, i) => { const b = corners[(i + 1) % corners.length]; return sum + points[a][0] * points[b][1] - points[a][1] * points[b][0]; }, 0);
    // Counter-clockwise from outside; y runs down.
    if (area >= 0) continue;
    corners.forEach((a, i) => {
      const b = corners[(i + 1) % corners.length], key = a < b ? `${a} ${b}` : `${b} ${a}`;
      seen.set(key, (seen.get(key) || 0) + 1);
    });
  }
  const at = (i) => points[i].map((v) => v.toFixed(2)).join(" ");
  const path = (count) => [...seen].filter(([, n]) => n === count).map(([key]) => { const [a, b] = key.split(" "); return `M${at(a)}L${at(b)}`; }).join("");
  return {outline: path(1), crown: path(2)};
}

class PhotographScreen {
  constructor() {
    this.stage = by_id("stage");
    const on = (id, act) => by_id(id).addEventListener("click", act);
    by_id("photo-file").addEventListener("change", (event) => this.take(event.target.files[0]));
    take_drops(by_id("photograph"), (file) => this.take(file));
    on("photo-lay", () => this.lay());
    on("photo-anew", () => this.place(structuredClone(this.state.about.view), false));
    on("photo-look", () => this.ask("/api/photograph/look", {opened: this.state.opened}));
    // In another light the stone lies where it lay.
    by_id("photo-light").addEventListener("change", () => { this.placed = this.state.found; this.lay(); });
    on("photo-cancel", () => call("/api/photograph/cancel", {}));
    on("stage-whole", () => this.look_whole(!this.whole));
    on("stage-larger", () => this.size(0.02));
    on("stage-smaller", () => this.size(-0.02));
    this.stage.addEventListener("pointerdown", (event) => this.grab(event));
    this.stage.addEventListener("pointermove", (event) => this.drag(event));
    this.stage.addEventListener("wheel", (event) => { event.preventDefault(); this.size(-event.deltaY / 2000); }, {passive: false});
  }

  async show() {
    const state = await call("/api/photograph");
    if (state) this.draw(state);
  }

  async ask(path, body) {
    const state = await call(path, body);
    if (state) this.draw(state);
  }

  hear(news) {
    if (!this.state || news.step !== this.state.step) return this.show();
    this.tell_progress(news.fraction);
  }

  async take(file) {
    const most = 64 << 20;
    if (file && file.size > most) show_trouble(`${file.name} is larger than 64 MB: copy it into the stone's folder, and choose it here.`);
    else if (file) {
      by_id("photo-note").textContent = `${file.name} is read…`;
      const state = await call("/api/photograph/upload", file, `&name=${encodeURIComponent(file.name)}`);
      state ? this.draw(state) : this.show();
    }
    by_id("photo-file").value = "";
  }

  /** `state`: the photograph of all windows, with the files of the folder. */
  draw(state) {
    if (this.state && state.step < this.state.step && state.opened === this.state.opened) return;
    const before = this.state;
    this.state = state;
    by_id("photos").replaceChildren(...state.files.map((file) => made("button", {type: "button", "aria-current": file === state.file ? "true" : null,
      onclick: () => this.ask("/api/photograph/open", {opened: state.opened, file})}, file)));
    by_id("photo-note").textContent = state.files.length ? "Or one that lies in the stone's folder:" : "It is kept in the stone's folder.";
    by_id("photo-stage").hidden = !state.file;
    by_id("photograph").classList.toggle("chosen", state.file !== "");
    if (state.trouble && state.trouble !== "stopped") show_trouble(state.trouble);
    const key = JSON.stringify([state.opened, state.file, state.about]), fresh = key !== this.key;
    if (!state.file) { this.key = ""; return this.look_at_report(); }
    if (fresh) this.load(key);
    // A person's own move is not undone by news of the same work.
    if (fresh || !before || JSON.stringify(before.view) !== JSON.stringify(state.view)) this.place(structuredClone(state.view), state.placed);
    by_id("photo-about").textContent = state.about.notes.map((note) => note[0].toUpperCase() + note.slice(1)).join(". ") + ".";
    const card = by_id("photo-card");
    // The program's own page parts, in which it escapes all texts.
    if (state.card_html) card.innerHTML = state.card_html;
    else card.replaceChildren(made("p", {}, state.phase ? "" : "Draw the outline onto the stone, about as it lies, and lay it on."));
    if (state.card_html && !state.found) by_id("photo-by-person").open = true;
    by_id("photo-stale").hidden = !state.stale;
    by_id("photo-look").hidden = !state.card_html || (state.found && !state.can_look);
    by_id("photo-look").textContent = state.found ? "What the readings leave open" : "Compare all the same";
    by_id("photo-look").disabled = by_id("photo-lay").disabled = state.phase !== "";
    by_id("photo-notes").replaceChildren(...state.notes.map((note) => made("li", {}, note)));
    this.tell_progress(state.fraction);
    this.look_at_report();
  }

  load(key) {
    this.key = key;
    const {width, height} = this.state.about, image = by_id("stage-photo");
    image.setAttribute("href", `/api/photograph/photo.png?window=${window_id}&step=${this.state.step}`);
    image.setAttribute("width", width);
    image.setAttribute("height", height);
    by_id("photo-by-hand").checked = this.state.by_hand;
    by_id("photo-light").replaceChildren(...this.state.lights.map((light) => made("option", {value: light}, light || "the scene of job.toml")));
    by_id("photo-light").value = this.state.light;
    this.whole = false;
  }

  tell_progress(fraction) {
    const phase = this.state.phase, words = {laying: "Laying the stone on", quick: "Comparing", nearby: "Looking at views nearby", open: "Drawing stones within the readings"};
    by_id("photo-work").hidden = !phase;
    if (phase !== this.phase) this.began = performance.now();
    this.phase = phase;
    const bar = by_id("photo-progress");
    if (fraction > 0) bar.value = fraction; else bar.removeAttribute("value");
    const left = time_left(this.began, fraction);
    by_id("photo-left").textContent = (words[phase] || "") + (left ? `, ${left}` : "…");
  }

  async look_at_report() {
    const place = by_id("photo-report"), step = this.state.step;
    const report = await call("/api/photograph/report");
    if (!report || step !== this.state.step || report.html === this.html) return;
    this.html = report.html;
    for (const pressed of place.querySelectorAll(".blink[aria-pressed=true]")) pressed.click();
    // The parts of the report that culet compare writes; it escapes all texts. A page has no inline styles.
    place.innerHTML = report.html.replaceAll(/ style="background:([^"]*)"/g, ' data-background="$1"');
    for (const bar of place.querySelectorAll("[data-background]")) bar.style.background = bar.dataset.background;
    place.querySelectorAll(".slider").forEach(move_divider);
    // Beside the stone; its part of the report tells the figures.
    by_id("photo-verdict").replaceChildren(...place.querySelectorAll(".headline > .verdict"));
  }

  lay() {
    if (!this.state.phase) this.ask("/api/photograph/lay", {opened: this.state.opened, view: this.view, placed: this.placed, by_hand: by_id("photo-by-hand").checked, light: by_id("photo-light").value});
  }

  /** `by_person`: the stone is then sought near it. */
  place(view, by_person) {
    this.view = view;
    this.placed = by_person;
    const points = projected(this.state.wire, view), paths = wire_paths(this.state.wire, points);
    by_id("stage-outline").setAttribute("d", paths.outline);
    by_id("stage-crown").setAttribute("d", paths.crown);
    if (!by_person || !this.stage.hasAttribute("viewBox")) this.look_whole(this.whole);
  }

  /** The whole photograph, or the stone with what is around it. */
  look_whole(whole) {
    this.whole = whole;
    const {width, height} = this.state.about, points = projected(this.state.wire, this.view);
    const box = [0, 1].map((i) => [Math.min(...points.map((p) => p[i])), Math.max(...points.map((p) => p[i]))]);
    const margin = 0.35 * Math.max(box[0][1] - box[0][0], box[1][1] - box[1][0]);
    const [[left, right], [top, bottom]] = box.map(([low, high], i) => whole || !this.state.found ? [0, [width, height][i]]
      : [Math.max(low - margin, 0), Math.min(high + margin, [width, height][i])]);
    this.stage.setAttribute("viewBox", `${left} ${top} ${Math.max(right - left, 1)} ${Math.max(bottom - top, 1)}`);
    by_id("stage-whole").setAttribute("aria-pressed", whole);
    by_id("stage-whole").hidden = !this.state.found;
  }

  moved(change) {
    const view = structuredClone(this.view);
    change(view);
    this.place(view, true);
  }
  move(x, y) { this.moved((view) => { view.at = [view.at[0] + x, view.at[1] + y]; }); }
  turn(axis, angle) { this.moved((view) => { view.turn = product(rotation(axis, angle), view.turn); }); }
  /** The lens stays: what is larger is nearer. */
  size(by) { this.moved((view) => { const grown = Math.exp(by); view.scale *= grown; view.nearness *= grown; }); }
  /** The near side follows the pointer. */
  tilt(x, y) { const radius = this.state.wire.diameter * this.view.scale / 2; this.turn(1, -x / radius); this.turn(0, y / radius); }

  at(event) {
    const point = new DOMPoint(event.clientX, event.clientY).matrixTransform(this.stage.getScreenCTM().inverse());
    return [point.x, point.y];
  }

  grab(event) {
    this.stage.setPointerCapture(event.pointerId);
    this.from = this.at(event);
  }

  drag(event) {
    if (!(event.buttons & 1) || !this.from) return;
    const [from, to, how] = [this.from, this.at(event), document.querySelector("[name=stage-drag]:checked").value];
    const angle = (p) => Math.atan2(p[1] - this.view.at[1], p[0] - this.view.at[0]);
    if (how === "move") this.move(to[0] - from[0], to[1] - from[1]);
    else if (how === "turn") this.turn(2, angle(to) - angle(from));
    else this.tilt(to[0] - from[0], to[1] - from[1]);
    this.from = to;
  }

  on_key(event) {
    if (!this.state || !this.state.file || event.altKey || event.metaKey || event.target.closest("input, select")) return;
    const fine = event.shiftKey ? 0.1 : 1, arrows = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]};
    const step = 0.02 * this.state.wire.diameter * this.view.scale * fine, turn = 0.035 * fine, grow = 0.02 * fine;
    const acts = {"[": () => this.turn(2, -turn), "]": () => this.turn(2, turn), "{": () => this.turn(2, -turn), "}": () => this.turn(2, turn),
      "+": () => this.size(0.02), "=": () => this.size(grow), "-": () => this.size(-grow), "_": () => this.size(-grow),
      z: () => this.look_whole(!this.whole), b: () => { const blink = by_id("photo-report").querySelector(".blink"); if (blink) blink.click(); }};
    // A button and a summary take Enter themselves.
    if (!event.target.closest("button, a, summary")) acts.enter = () => this.lay();
    const [x, y] = arrows[event.key] || [0, 0];
    const act = arrows[event.key] ? () => (event.ctrlKey ? this.tilt(x * step, y * step) : this.move(x * step, y * step)) : !event.ctrlKey && acts[event.key.toLowerCase()];
    if (!act || event.target.closest(".scroll")) return;
    event.preventDefault();
    act();
  }
}
