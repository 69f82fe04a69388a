// The export screen: files that the program makes and the browser saves.

class ExportScreen {
  constructor() {
    for (const button of by_id("kinds").children) button.addEventListener("click", () => this.make(button.dataset.kind));
    by_id("cancel-file").addEventListener("click", () => call("/api/export/cancel", {}));
  }

  async show() {
    const file = await call("/api/export");
    if (file) this.draw(file);
  }

  async make(kind) {
    const file = await call("/api/export/make", {opened: this.file.opened, kind});
    if (!file) return;
    this.asked = file.number;
    // It may be there before this answer is.
    this.show();
  }

  /** `file`: the last one that any window asked for. */
  draw(file) {
    this.file = file;
    for (const button of by_id("kinds").children) button.setAttribute("aria-disabled", file.runs);
    by_id("file-work").hidden = !file.runs;
    by_id("file-progress").value = file.fraction;
    const line = by_id("file-line"), there = !file.runs && file.file;
    const link = there && made("a", {href: `/api/export/file?window=${window_id}`, download: file.file}, file.file);
    line.replaceChildren(...(there ? [link, ` (${Math.ceil(file.size / 1000)} kB) is ready.`] : [file.runs ? "" : file.trouble]));
    by_id("file-notes").replaceChildren(...file.notes.map((note) => made("li", {}, note)));
    if (!file.runs && file.number === this.asked && file.by === window_id) {
      this.asked = 0;
      line.scrollIntoView({block: "nearest"});
      if (there) link.click();
    }
  }
}
