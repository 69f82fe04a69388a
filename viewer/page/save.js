"use strict";
// Exports: the picture, a film of a turn, a link, the command that draws the picture.

function download(blob, name) {
  const address = URL.createObjectURL(blob);
  const link = element("a", {href: address, download: name});
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(address), 10000);
}

const k_record = "Save a turn as a film";

class PanelSave {
  constructor(page) {
    this.page = page;
    this.turntable = new Turntable(page);
    this.progress =
      element("progress", {max: 1, value: 0, hidden: true, "aria-label": "Recording"});
    this.left = element("p", {class: "note", hidden: true});
    this.seconds = 4;
    this.length = slider({
      name: "seconds",
      label: "Length",
      least: 2,
      most: 12,
      step: 1,
      unit: " s",
      value: this.seconds,
      onchange: (value) => {
        this.seconds = value;
      }
    });
    this.record = button(k_record, () => this.film(), {class: "wide", "data-name": "record"});
    this.command = element("textarea", {
      readonly: true,
      rows: 7,
      spellcheck: "false",
      "aria-label": "Command that draws this picture",
      "data-name": "command"
    });
    this.command_note = element("p", {class: "note"});
    this.node = element("div", {},
      group("Picture", "At the resolution of this screen, without the lines drawn over it.",
        button("Save as PNG", () => this.save_png(), {class: "wide", "data-name": "png"})),
      group("Film", "One turn about the stone\u2019s axis.", this.length, this.record,
        this.progress, this.left),
      group("Link",
        "Opens this page as it is now: view, light, material, all but files that were dropped.",
        button("Copy the link", () => this.copy(this.link(), "The link is copied."),
          {class: "wide", "data-name": "link"})),
      group("Command", "Draws this very picture with culet on the command line.", this.command,
        this.command_note,
        button("Copy the command",
          () => this.copy(this.page.command.line(), "The command is copied."),
          {class: "wide", "data-name": "copy-command"})));
  }

  file_name(ending) {
    const name =
      this.page.shown_name().replace(/[^\p{L}\p{N}._-]+/gu, "-").replace(/^-+|-+$/g, "") || "stone";
    return name + ending;
  }
  link() { return location.href.replace(/#.*$/, "") + "#" + this.page.state.fragment(); }

  async save_png() {
    await this.page.loop.idle();
    const view = this.page.gpu.shown ? this.page.gpu : this.page.picture;
    download(await view.png(), this.file_name(".png"));
    this.page.say("The picture is saved.");
  }

  async copy(text, done) {
    try {
      await navigator.clipboard.writeText(text);
    } catch {
      // Pages opened from a file may not use the clipboard: the old way.
      const field = element("textarea", {class: "unseen"});
      field.value = text;
      document.body.append(field);
      field.select();
      const copied = document.execCommand("copy");
      field.remove();
      if (!copied)
        return this.page.say(
          "The browser did not let the page copy: select the text and copy it by hand.");
    }
    return this.page.say(done);
  }

  async film() {
    if (this.turntable.recording) {
      this.turntable.stop();
      return;
    }
    this.record.textContent = "Cancel";
    this.progress.hidden = this.left.hidden = false;
    const begin = performance.now();
    const progress = (share) => {
      const seconds = (performance.now() - begin) / 1000 * (1 - share) / share;
      this.progress.value = share;
      this.left.textContent = share < 1 ? `About ${Math.ceil(seconds)} s left` : "Writing the file";
    };
    try {
      const film = await this.turntable.film(this.seconds, progress);
      if (film) download(film, this.file_name(film.type === "video/mp4" ? ".mp4" : ".webm"));
      this.page.say(film ? "The film is saved." : "The film is cancelled.");
    } catch (error) {
      this.page.failed(error);
    } finally {
      this.record.textContent = k_record;
      this.progress.hidden = this.left.hidden = true;
      this.progress.value = 0;
      this.left.textContent = "";
      this.page.loop.paused = false;
      this.page.loop.changed();
    }
  }

  update() {
    // One line per setting, in shell syntax.
    const command = this.page.command.line().replace(/ (?=--set )/g, " \\\n  ");
    if (this.command.value !== command) this.command.value = command;
    this.command_note.textContent = this.page.command.limits();
    this.command_note.hidden = !this.command_note.textContent;
  }
}
