"use strict";
// The command that draws what the page shows.

const k_unnamed_material = "--material MATERIAL.toml";  // as the engine writes it

class Command {
  constructor(page) { this.page = page; }

  line() {
    if (!this.page.ready()) return "";
    const [width, height] = this.page.picture.size(), stone = this.page.shown_index(),
                  values = this.page.state.values;
    const settings = this.page.settings(stone);
    // The scene's own light by its name. A stone without a scene has no light of its own to turn.
    if (this.page.own_light() && !settings.some((key) => key.startsWith("light")))
      settings.push(`light.preset=${toml_text(this.page.own_light())}`);
    const rays = this.page.drawn_by_rays;
    if (rays) settings.push("render.samples=1");
    return command_line({
      command: this.of_stone(stone),
      settings,
      camera: this.page.drawing(stone, width, height).camera,
      size: [width, height],
      exposure: this.page.exposure_factor(),
      tonemap: this.page.tonemap(),
      engine: rays ? "reference" : "beams",
      lights_turned: values.polariser === null ? this.page.lights_turn() : null,
    });
  }
  // The command up to the file. A standard cut is made first.
  of_stone(index) {
    const {cut, convex, material} = this.page.item().stones[index];
    const changed = this.page.state.get("cut");
    // --light would hide all other light settings.
    if (!changed && this.page.item().command)
      return this.page.item().command.replace(/ --light (?:'[^']*'|\S+)/, "");
    if (!cut) return "culet render STONE";
    const sizes = Object.entries({...cut.values, ...changed}).map(([name,
      value]) => ` --${name} ${toml_number(value)}`);
    return `culet cut ${cut.kind}${
      sizes.join("")} -o design.obj && culet render design.obj --material ${
      quoted(material.id || "diamond")}${convex === false ? " --set convex=false" : ""}`;
  }
  // What the command cannot express.
  limits() {
    const values = this.page.state.values, limits = [];
    if (values.light === "panorama" && this.page.panorama)
      limits.push(`It looks for ${this.page.panorama.name} beside the stone\u2019s file.`);
    if (this.page.item().command.endsWith(k_unnamed_material))
      limits.push("Its material is in no catalogue: name its file.");
    if (this.page.document_stone().role === "catalogue")
      limits.push("It draws the fitted stone; the page shows the catalogue\u2019s.");
    return limits.join(" ");
  }
}
