"use strict";
// The elements of the panels. Text is inserted as text, never as HTML.

function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === undefined || value === null || value === false) continue;
    if (name.startsWith("on"))
      made.addEventListener(name.slice(2), value);
    else if (name === "value" || name === "checked" || name === "disabled")
      made[name] = value;
    else
      made.setAttribute(name, value === true ? "" : value);
  }
  made.append(...children.filter((child) => child !== null && child !== undefined));
  return made;
}

function svg_element(tag, attributes = {}, ...children) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
}

let count_of_controls = 0;
function new_id(word) { return word + "-" + ++count_of_controls; }

function group(title, note, ...controls) {
  const id = new_id("group");
  return element("section", {class: "group", "aria-labelledby": id}, element("h3", {id}, title),
    note ? element("p", {class: "note"}, note) : null, ...controls);
}

function button(text, onclick, attributes = {}) {
  return element("button", {type: "button", onclick, ...attributes}, text);
}

// A slider with a text field. `options`: {label, least, most, step, unit, digits, value, what,
// onchange(value, done)}; `done` is false while the slider is dragged.
function slider(options) {
  const id = new_id("slider");
  const shown = (value) => value.toFixed(options.digits ?? 0) + (options.unit || "");
  const number = element("output", { class: "number", for: id }, shown(options.value));
    const input = element("input", {
      type: "range",
      id,
      min: options.least,
      max: options.most,
      step: options.step ?? "any",
      "aria-describedby": options.what ? id + "-what" : null,
    });
    input.value = options.value;
    const tell = (done) => {
      const value = Number(input.value);
      number.textContent = shown(value);
      input.setAttribute("aria-valuetext", shown(value));
      options.onchange(value, done);
    };
    input.addEventListener("input", () => tell(false));
    input.addEventListener("change", () => tell(true));
    const made =
      element("div", {class: "control slider-control", "data-name": options.name || null},
        element("label",
          { for: id
          },
          options.label),
        number, input,
        options.what ? element("p", {class: "what", id: id + "-what"}, options.what) : null);
    made.show = (value) => {
      if (document.activeElement !== input || Number(input.value) !== value) input.value = value;
      number.textContent = shown(value);
      input.setAttribute("aria-valuetext", shown(value));
    };
    made.input = input;
    return made;
}

function toggle(label, onchange, attributes = {}) {
    const id = new_id("toggle");
    const input = element("input", {
      type: "checkbox",
      role: "switch",
      id,
      onchange: () => onchange(input.checked),
      "data-name": attributes.name || null,
    });
    const made = element("div", {class: "control toggle"}, input, element("label", { for: id
    }, label, attributes.what ? element("span", {class: "what"}, attributes.what) : null));
    made.show = (on) => {
      input.checked = on;
    };
    made.input = input;
    made.what = (text) => {
      made.querySelector(".what").textContent = text;
    };
    return made;
}

// `choices`: [{value, label, what}]; `style`: "cards" (each with its explanation) or "segments"
// (side by side).
function choice(legend, choices, onchange, style, name) {
    const group_name = new_id("choice");
    const inputs = choices.map(({value}) => element("input", {
      type: "radio",
      name: group_name,
      value: String(value),
      id: new_id("option"),
      onchange: () => onchange(value),
    }));
    const made = element("fieldset", {class: "control choice " + style, "data-name": name || null},
      element("legend", {class: style.startsWith("cards") ? "unseen" : null}, legend),
      ...choices.map(
        ({label, what}, i) => element("div", {class: "option"}, inputs[i], element("label", { for: inputs[i].id
        }, element("b", {}, label), what ? element("span", {class: "what"}, what) : null))));
    made.show = (value) => {
      for (const input of inputs) input.checked = input.value === String(value);
    };
    made.allow = (value, allowed) => {
      for (const input of inputs)
        if (input.value === String(value)) input.disabled = !allowed;
    };
    return made;
}

// Degrees, by a dial and a number field.
function dial(label, onchange, name) {
    const id = new_id("dial");
    const needle = svg_element("line", {x1: 3, y1: 20, x2: 37, y2: 20, class: "needle"});
    const face =
      svg_element("svg", {viewBox: "0 0 40 40", class: "dial-face", "aria-hidden": "true"},
        svg_element("circle", {cx: 20, cy: 20, r: 18}), needle);
    const input = element("input", {
      type: "number",
      id,
      min: -360,
      max: 360,
      step: 1,
      "data-name": name || null,
      onchange: () => {
        if (Number.isFinite(input.valueAsNumber)) onchange(input.valueAsNumber);
      },
    });
    const follow = (event) => {
      const box = face.getBoundingClientRect();
      const x = event.clientX - box.left - box.width / 2,
            y = event.clientY - box.top - box.height / 2;
      if (Math.hypot(x, y) < 3) return;
      // A polariser is the same after half a turn.
      onchange(((Math.round(Math.atan2(-y, x) * 180 / Math.PI) % 180) + 180) % 180);
    };
    face.addEventListener("pointerdown", (event) => {
      if (made.off) return;
      face.setPointerCapture(event.pointerId);
      follow(event);
    });
    face.addEventListener("pointermove", (event) => {
      if (!made.off && event.buttons & 1) follow(event);
    });
    const made = element("div", {class: "control dial"}, face, element("label", { for: id
    }, label), input, element("span", {class: "unit"}, "\u00b0"));
    made.show = (degrees) => {
      made.off = degrees === null;
      input.disabled = made.off;
      made.classList.toggle("off", made.off);
      if (made.off) return;
      if (document.activeElement !== input || input.valueAsNumber !== degrees)
        input.value = degrees;
      needle.setAttribute("transform", `rotate(${- degrees} 20 20)`);
    };
    return made;
}

function file_button(label, accept, onfile) {
    const input = element("input", {
      type: "file",
      accept,
      class: "unseen",
      tabindex: -1,
      "aria-hidden": "true",
      onchange: () => {
        if (input.files[0]) onfile(input.files[0]);
        input.value = "";
      },
    });
    return element(
      "div", {class: "control"}, input, button(label, () => input.click(), {class: "wide"}));
}
