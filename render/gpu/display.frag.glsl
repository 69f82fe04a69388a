// Shows the sum of samples with exposure, tone map and sRGB, like the PNGs of image/film_look.cpp.
// Compiled after a line `#version 300 es`.
precision highp float;
precision highp int;
precision highp sampler2D;

uniform sampler2D u_sum;
uniform float u_exposure;  // exposure over the number of samples
uniform int u_tone_map;    // ToneMap of image/film_look.h: none, reinhard, filmic, gamma2

out vec4 out_colour;

vec3 srgb_encoded(vec3 v) {
    return mix(12.92 * v, 1.055 * pow(max(v, 0.0031308), vec3(1.0 / 2.4)) - 0.055,
               greaterThan(v, vec3(0.0031308)));
}

void main() {
    vec3 v = u_exposure * texelFetch(u_sum, ivec2(gl_FragCoord.xy), 0).rgb;
    // Clamp: brighter values look alike, and squares stay finite. NaN becomes 0.
    v = vec3(v.r > 0.0 ? min(v.r, 1e15) : 0.0, v.g > 0.0 ? min(v.g, 1e15) : 0.0,
             v.b > 0.0 ? min(v.b, 1e15) : 0.0);
    if (u_tone_map == 3) {
        // For a display of gamma 2, store the square root.
        out_colour = vec4(sqrt(min(v, 1.0)), 1.0);
        return;
    }
    if (u_tone_map == 1) v = v / (1.0 + v);
    if (u_tone_map == 2) v = v * (2.51 * v + 0.03) / (v * (2.43 * v + 0.59) + 0.14);
    out_colour = vec4(srgb_encoded(min(v, 1.0)), 1.0);
}
