"use strict";
// An MP4 file of one film (ISO/IEC 14496-12), all frames of one duration.

const k_film_ticks = 512;  // of a frame

function u16(...values) { return values.flatMap((v) => [v >>> 8 & 255, v & 255]); }
function u32(...values) { return values.flatMap((v) => [...u16(v >>> 16), ...u16(v)]); }
function zeros(count) { return new Array(count).fill(0); }
function ascii(text) { return Array.from(text, (c) => c.charCodeAt(0)); }
function mp4_box(kind, ...parts) {
  const body = parts.flatMap((part) => Array.from(part));
  return [...u32(8 + body.length), ...ascii(kind), ...body];
}
// With a version of 0 and flags.
function full_box(kind, flags, ...parts) { return mp4_box(kind, u32(flags), ...parts); }

const k_upright = u32(0x10000, 0, 0, 0, 0x10000, 0, 0, 0, 0x40000000);

// What the pixels mean, by the code points of ISO/IEC 23091-2.
function colour_box({primaries, transfer, matrix, fullRange}) {
  const codes = {bt709: 1, bt470bg: 5, smpte170m: 6, rgb: 0, "iec61966-2-1": 13};
  const [p, t, m] = [primaries, transfer, matrix].map((name) => codes[name] ?? 2);
  return mp4_box("colr", ascii("nclx"), u16(p, t, m), [fullRange ? 128 : 0]);
}

// `config`: the encoder's, with `codec` (avc1..., vp09.profile.level.bits) and `description`.
function sample_entry(config, width, height) {
  const picture = [
    zeros(6), u16(1), zeros(16), u16(width, height), u32(0x480000, 0x480000, 0), u16(1), zeros(32),
    u16(24, 0xffff), config.colorSpace ? colour_box(config.colorSpace) : []
  ];
  if (config.codec.startsWith("avc1"))
    return mp4_box("avc1", ...picture, mp4_box("avcC", new Uint8Array(config.description)));
  const [profile, level, bits] = config.codec.split(".").slice(1).map(Number);
  const about = [profile, level, bits << 4 | 2, 2, 2, 2, 0, 0];  // 4:2:0
  return mp4_box("vp09", ...picture, mp4_box("vpcC", u32(0x1000000), about));
}

// `samples`: [{bytes, key}] in order. The chunk offset is known only once the boxes before it are.
function mp4_file(config, width, height, rate, samples) {
  const count = samples.length, scale = rate * k_film_ticks, duration = count * k_film_ticks;
  const keys = samples.flatMap(({key}, i) => key ? [i + 1] : []);
  const tables = (at) =>
    mp4_box("stbl", full_box("stsd", 0, u32(1), sample_entry(config, width, height)),
      full_box("stts", 0, u32(1, count, k_film_ticks)),
      full_box("stss", 0, u32(keys.length, ...keys)), full_box("stsc", 0, u32(1, 1, count, 1)),
      full_box("stsz", 0, u32(0, count, ...samples.map(({bytes}) => bytes.length))),
      full_box("stco", 0, u32(1, at)));
  const head = (at) => [...mp4_box("ftyp", ascii("isom"), u32(512), ascii("isomiso6mp41")),
    ...mp4_box("moov",
      full_box("mvhd", 0, u32(0, 0, scale, duration, 0x10000), u16(256), zeros(10), k_upright,
        zeros(24), u32(2)),
      mp4_box("trak",
        full_box("tkhd", 3, u32(0, 0, 1, 0, duration), zeros(16), k_upright,
          u32(width << 16, height << 16)),
        mp4_box("mdia", full_box("mdhd", 0, u32(0, 0, scale, duration), u16(0x55c4, 0)),
          full_box("hdlr", 0, u32(0), ascii("vide"), zeros(13)),
          mp4_box("minf", full_box("vmhd", 1, zeros(8)),
            mp4_box("dinf", full_box("dref", 0, u32(1), full_box("url ", 1))), tables(at))))),
  ];
  const size = samples.reduce((sum, {bytes}) => sum + bytes.length, 8);
  const before = [...head(head(0).length + 8), ...u32(size), ...ascii("mdat")];
  return new Blob(
    [new Uint8Array(before), ...samples.map(({bytes}) => bytes)], {type: "video/mp4"});
}
