// Calls to the studio, and small pieces of the page. Texts from files become text nodes only.
"use strict";
const window_id = crypto.getRandomValues(new Uint32Array(2)).join("-");
const by_id = (id) => document.getElementById(id);

/** "about N s left" of work begun at `began` (performance.now()); "" while too little is done to say so. */
function time_left(began, fraction) {
  const gone = (performance.now() - began) / 1000, left = gone * (1 - fraction) / fraction;
  return fraction > 0.05 && gone > 2 && left < 3600 ? `about ${Math.max(1, Math.round(left))} s left` : "";
}

/** An element with attributes (`on...`: a listener) and children. */
function made(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (value === true) element.setAttribute(name, "");
    else if (value !== false && value !== null && value !== undefined) element.setAttribute(name, value);
  }
  element.append(...children);
  return element;
}

function show_trouble(text) {
  by_id("trouble-text").textContent = text;
  by_id("trouble").hidden = !text;
}

/** The answer, or null after the trouble was shown. `body` undefined: a question. */
async function call(path, body, parameters = "") {
  const posts = body !== undefined;
  const raw = body instanceof Blob;
  try {
    const answer = await fetch(`${path}?window=${window_id}${parameters}`, {
      method: posts ? "POST" : "GET", body: posts ? (raw ? body : JSON.stringify(body)) : undefined});
    const type = answer.headers.get("Content-Type") || "";
    const content = type.startsWith("application/json") ? await answer.json() : {trouble: await answer.text()};
    if (answer.ok && posts) show_trouble("");
    if (answer.ok) return content;
    show_trouble(content.trouble);
  } catch (error) {
    show_trouble("The studio does not answer: was it ended? Start it again, and open the address that it prints.");
  }
  return null;
}

/** A file that is dropped onto a place. */
function take_drops(place, take) {
  place.addEventListener("dragover", (event) => { event.preventDefault(); place.classList.add("over"); });
  place.addEventListener("dragleave", () => place.classList.remove("over"));
  place.addEventListener("drop", (event) => {
    event.preventDefault();
    place.classList.remove("over");
    take(event.dataTransfer.files[0]);
  });
}

function say(text) { by_id("say").textContent = text; }
