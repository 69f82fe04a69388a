// The stone screen: the viewer's page with the fitted stone beside its mesh, and what the fit says of it.

class StoneScreen {
  /** `studio`: the page, whose fit is shown. */
  constructor(studio) {
    this.studio = studio;
    serve_engine(by_id("stone-frame"));
  }

  show() {
    const {fit, opened} = this.studio;
    if (!fit) return;
    const shown = `${opened}-${fit.revision}`;
    by_id("stone-waits").hidden = !fit.runs;
    // A stone that turns is not taken out of the hand while a newer one is being fitted.
    if (fit.runs && this.opened === opened) return;
    if (this.shown !== shown) by_id("stone-frame").src = `/view?shown=${shown}`;
    this.shown = shown;
    this.opened = opened;
    // The program's own page parts, in which it escapes all texts.
    const words = by_id("stone-words");
    words.innerHTML = (fit.fit && fit.fit.stone_html) || "";
    // They stand on Readings too.
    for (const name of ["id", "aria-labelledby"]) words.querySelectorAll(`[${name}]`).forEach((part) => part.removeAttribute(name));
  }
}
