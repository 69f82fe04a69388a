// Light paths through a convex stone, one eye ray per pixel. gpu_program.h says how to drive it.
// gpu_program.cpp prepends `#version 300 es` and the definitions for one stone:
//   NODES             wavelengths per path, 1..4; Weights: float, vec2, vec3 or vec4 of them
//   PATHS             most paths per pass
//   POLARISED         faces polarise; RESPONSE: the eye responds to polarised light, and Stokes
//                     parameters of that response are carried, else those of an unpolarised ray
//   CRYSTAL           the stone has two waves, merged; ABSORBS: it is isotropic and not clear
//   SPHERES, PLANE_LIGHTS, LOBES, CAPS, LIGHTS (their sum); ENVIRONMENT; POLARISED_LIGHTS
//   BALANCE           a second target records the energy balance
// It replaces each line `//! planes` by a line PLANE(unit outward normal, offset) per facet:
// constants are several times faster here than a block of uniforms.
//
// Coordinates are the stone's, relative to its middle. A path is traced backwards from the eye, as
// in reference/light_paths.h: light that leaves through a face sees the lights there, and reflected
// light goes on. Carried along is (I, Q, U, V): sum and difference of the powers of s and p, and
// twice the real and imaginary part of E_s E_p*, in the frame (s, ray x s), with s along ray x
// outward normal.
precision highp float;
precision highp int;
precision highp sampler2D;

// The view: a ray starts at `u_at` + x `u_at_x` + y `u_at_y`, next to the stone, and its direction
// is likewise from `u_towards`. The eye lies `u_eye` times that direction before the start.
uniform vec3 u_at, u_at_x, u_at_y, u_towards, u_towards_x, u_towards_y;
uniform float u_eye;
uniform vec3 u_forward, u_right;  // unit axes of the picture

uniform int u_depth;  // most faces of a path
uniform float u_cut;  // paths of less weight end

uniform int u_paths;
uniform vec3 u_optics[PATHS];  // relative index n, n^2 - 1, n^2
uniform Weights u_absorption[PATHS];
uniform vec3 u_colour[PATHS * NODES];  // linear sRGB of a radiance of 1
uniform Weights u_share[PATHS];        // over all wavelengths; 0: padding
uniform vec4 u_response[PATHS];        // Stokes parameters, y downwards

// MergedCrystal of optics/merged_crystal.h.
uniform vec3 u_optic_axis[2 * PATHS];
uniform vec4 u_waves[PATHS];  // 1/n^2: half sum, half difference; waves and coherence per length
uniform vec3 u_principal[3], u_principal_absorption[PATHS];

// Lights in the order spheres, planes, lobes, caps.
uniform mat3 u_light_turn;  // from the stone's frame to that of the lights
uniform float u_constant;
#if LIGHTS > 0
uniform Weights u_radiance[PATHS * LIGHTS];
#endif
#if SPHERES > 0
uniform vec4 u_spheres[SPHERES];  // centre, radius
#endif
#if LAMPS > 0
uniform vec4 u_lamps[2 * LAMPS];  // zero angle, number of its sphere; zero azimuth
uniform sampler2D u_lamp_shares;  // lamp_texture in gpu_program.cpp
#endif
#if PLANE_LIGHTS > 0
uniform vec4 u_planes[3 * PLANE_LIGHTS];  // normal, offset; two rows: lit where both are in -1..1
#endif
#if LOBES > 0
uniform vec4 u_lobes[LOBES];      // direction, exponent
uniform int u_lobe_whole[LOBES];  // the exponent if it is a small integer, else -1
#endif
#if CAPS > 0
uniform vec4 u_caps[2 * CAPS];  // direction, outer cosine; outer sine, inner cosine, inner sine
#endif
#if POLARISED_LIGHTS
uniform vec4 u_vibration[2 * LIGHTS + 2];  // vibration, degree; sheet normal, 1 if any
#endif
#if ENVIRONMENT
uniform sampler2D u_environment;        // lat-long: scene/environment_layout.h
uniform Weights u_red[PATHS], u_blue[PATHS];  // what red and blue add to green at a wavelength
#endif

uniform sampler2D u_sum;
uniform float u_keep;  // 0 in the first draw
layout(location = 0) out vec4 out_sum;
#if BALANCE
uniform sampler2D u_balance, u_length;
uniform vec3 u_luminance;                   // of linear sRGB
layout(location = 1) out vec4 out_balance;  // of the stone: remainder, absorbed, cut, luminance
layout(location = 2) out float out_length;  // faces of the longest path that carried light
#endif

const float k_infinite = 3e38;
// Least squared sine of incidence for which single precision defines a plane of incidence.
const float k_straight = 1e-12;

// ------------------------------------------------------------------------------------- the stone

struct Hit {
    float distance;
    vec3 normal;
    float offset;
};

// Where a ray enters from outside; `distance` k_infinite if it misses.
Hit entry(vec3 p, vec3 d) {
    Hit hit = Hit(-k_infinite, vec3(0.0), 0.0);
    float leave = k_infinite;
#define PLANE(n, o)                                                     \
    {                                                                   \
        float t = dot(n, d), below = o - dot(n, p), way = below / t;    \
        if (t < 0.0 && way > hit.distance) hit = Hit(way, n, o);        \
        if (t > 0.0) leave = min(leave, way);                           \
        if (t == 0.0 && below < 0.0) leave = -k_infinite;               \
    }
    //! planes
#undef PLANE
    if (!(hit.distance < leave)) hit.distance = k_infinite;
    return hit;
}

// Where a ray leaves: at the nearest plane ahead, which has the largest t / below. The sign of t
// excludes the facet just left. A start outside a plane by rounding counts as just inside.
Hit way_out(vec3 p, vec3 d) {
    float most = 0.0, offset = 0.0;
    vec3 normal = vec3(0.0);
#define PLANE(n, o)                                         \
    {                                                       \
        float near = dot(n, d) / max(o - dot(n, p), 1e-30); \
        if (near > most) {                                  \
            most = near;                                    \
            normal = n;                                     \
            offset = o;                                     \
        }                                                   \
    }
    //! planes
#undef PLANE
    return Hit(1.0 / most, normal, offset);
}

// -------------------------------------------------------------------------------------- one face

struct Face {
    float Rs, Rp;  // reflected powers
    float re, im;  // r_s r_p*
    float q2;      // n cos of the transmitted ray
    bool total;
};

// optics/fresnel.h. q1 = n1 cos; `step` = n2^2 - n1^2.
Face face_of(float e1, float e2, float step, float q1) {
    q1 = max(q1, 1e-18);
    float squared = q1 * q1 + step;
    if (squared > 0.0) {
        float q2 = sqrt(squared);
        // q1 - q2 = -step / (q1 + q2) keeps its digits for similar media; likewise for p if the
        // plain difference is small.
        float s = q1 + q2, p = e2 * q1 + e1 * q2, apart = e2 * q1 - e1 * q2;
        float rs = -step / (s * s),
              rp = abs(apart) > 0.1 * p
                       ? apart / p
                       : step * (e1 * e2 - (e1 - q1 * q1) * (e1 + e2)) / (p * p);
        return Face(rs * rs, rp * rp, rs * rp, 0.0, q2, false);
    }
    // Total reflection: r_s r_p* has twice the phase of A + i B.
    float kappa = sqrt(-squared);
    float A = e2 * q1 * q1 + e1 * kappa * kappa, B = (e1 - e2) * kappa * q1;
    float scale = 1.0 / max(A * A + B * B, 1e-30);
    return Face(1.0, 1.0, (A * A - B * B) * scale, 2.0 * A * B * scale, 0.0, true);
}

// Rotates the frame by the angle of (along, across), of any length.
vec4 turned(vec4 c, float along, float across) {
    float scale = 1.0 / max(along * along + across * across, 1e-30);
    float cosine = (along * along - across * across) * scale, sine = 2.0 * along * across * scale;
    return vec4(c.x, cosine * c.y + sine * c.z, cosine * c.z - sine * c.y, c.w);
}

vec4 reflected(vec4 c, Face f) {
    float sum = 0.5 * (f.Rs + f.Rp), apart = 0.5 * (f.Rs - f.Rp);
    return vec4(sum * c.x + apart * c.y, apart * c.x + sum * c.y, f.re * c.z - f.im * c.w,
                f.im * c.z + f.re * c.w);
}

vec4 transmitted(vec4 c, Face f) {
    float Ts = 1.0 - f.Rs, Tp = 1.0 - f.Rp;
    float sum = 0.5 * (Ts + Tp), apart = 0.5 * (Ts - Tp), both = sqrt(max(Ts * Tp, 0.0));
    return vec4(sum * c.x + apart * c.y, apart * c.x + sum * c.y, both * c.z, both * c.w);
}

vec3 mirrored(vec3 d, vec3 n) {
    vec3 v = d - 2.0 * dot(d, n) * n;
    // One Newton step towards unit length.
    return (1.5 - 0.5 * dot(v, v)) * v;
}

// ------------------------------------------------------------------------------------ the lights

// The end of a path: the eye's response to light along `ray`, with Q and U relative to the unit
// vector `u`.
struct End {
    float I, Q, U;
    vec3 u;
};

// Weight of light `number` along a ray; number LIGHTS: the environment and the constant light.
float weight_of(int number, vec3 ray, End end) {
#if POLARISED_LIGHTS
    vec4 vibration = u_vibration[2 * number], sheet = u_vibration[2 * number + 1];
    if (vibration.w == 0.0) return end.I;
    vec3 along = vibration.xyz;
    if (sheet.w > 0.0) {
        // Turned with the sheet's normal into the ray.
        vec3 normal = dot(sheet.xyz, ray) < 0.0 ? -sheet.xyz : sheet.xyz;
        along -= dot(along, ray) / (1.0 + dot(normal, ray)) * (normal + ray);
    }
    float a = dot(along, end.u), b = dot(along, cross(ray, end.u));
    float square = max(a * a + b * b, 1e-30);
    return end.I +
           vibration.w * (end.Q * (a * a - b * b) + end.U * 2.0 * a * b) / square;
#else
    return end.I;
#endif
}

// The nearest near light beyond `start` on a ray: its number, or -1.
int near_light(vec3 p, vec3 d, float start, out float distance) {
    int met = -1;
    distance = k_infinite;
#if SPHERES > 0
    for (int i = 0; i < SPHERES; ++i) {
        vec3 to = u_spheres[i].xyz - p;
        float along = dot(to, d);
        vec3 beside = to - along * d;
        float squared = u_spheres[i].w * u_spheres[i].w - dot(beside, beside);
        if (squared < 0.0) continue;
        float root = sqrt(squared), way = along - root > start ? along - root : along + root;
        if (way > start && way < distance) {
            distance = way;
            met = i;
        }
    }
#endif
#if PLANE_LIGHTS > 0
    for (int i = 0; i < PLANE_LIGHTS; ++i) {
        // Only from the lit side.
        vec4 plane = u_planes[3 * i];
        float towards = dot(plane.xyz, d);
        if (!(towards < 0.0)) continue;
        float way = (plane.w - dot(plane.xyz, p)) / towards;
        vec4 at = vec4(p + way * d, 1.0);
        float s = dot(u_planes[3 * i + 1], at), t = dot(u_planes[3 * i + 2], at);
        if (way > start && way < distance && abs(s) <= 1.0 && abs(t) <= 1.0) {
            distance = way;
            met = SPHERES + i;
        }
    }
#endif
    return met;
}

#if LOBES > 0
float lobe_share(int i, vec3 d) {
    float cosine = dot(u_lobes[i].xyz, d);
    if (!(cosine > 0.0)) return 0.0;
    float power = 1.0;
    if (u_lobe_whole[i] >= 0) {
        float square = cosine;
        for (int e = u_lobe_whole[i]; e > 0; e >>= 1) {
            if ((e & 1) == 1) power *= square;
            square *= square;
        }
        return power;
    }
    // Near the axis the cosine is 1 up to rounding, but the sine keeps its digits: use log(1 - x)
    // as the atanh series of -x / (2 - x) for x <= 0.02.
    vec3 across = cross(u_lobes[i].xyz, d);
    float x = dot(across, across), z = -x / (2.0 - x), zz = z * z;
    float logarithm = x < 0.02 ? z * (1.0 + zz * (1.0 / 3.0 + zz * 0.2)) : log(cosine);
    return exp(u_lobes[i].w * logarithm);
}
#endif

// Whether d is in a disc of the sky, given by the cosine and sine of its radius. For small discs
// only the sine resolves the distance in single precision.
bool in_disc(vec3 axis, vec3 d, float cosine, float sine) {
    float along = dot(axis, d);
    if (cosine < 0.7071 || cosine > 1.0) return along > cosine;
    vec3 across = cross(axis, d);
    return along > 0.0 && dot(across, across) < sine * sine;
}

#if ENVIRONMENT || LAMPS > 0
// Moshier's atanf (Cephes): error 2e-7 in any quadrant.
float angle_of(float y, float x) {
    float big = max(abs(x), abs(y)), small = min(abs(x), abs(y));
    float t = big > 0.0 ? small / big : 0.0, more = 0.0;
    if (t > 0.4142135624) {
        t = (t - 1.0) / (t + 1.0);
        more = 0.7853981634;
    }
    float z = t * t;
    float a = more + t + t * z *
              (((8.05374449538e-2 * z - 1.38776856032e-1) * z + 1.99777106478e-1) * z -
               3.33329491539e-1);
    if (abs(y) > abs(x)) a = 1.5707963268 - a;
    if (x < 0.0) a = 3.1415926536 - a;
    return y < 0.0 ? -a : a;
}
#endif

#if LAMPS > 0
// Part of a sphere's greatest radiance along a ray: 1 unless it is a lamp.
float lamp_share(int sphere, vec3 d) {
    for (int i = 0; i < LAMPS; ++i) {
        if (int(u_lamps[2 * i].w) != sphere) continue;
        vec3 axis = u_lamps[2 * i].xyz, zero = u_lamps[2 * i + 1].xyz;
        float x = -dot(d, zero), y = -dot(d, cross(zero, axis)), z = -dot(d, axis);
        float azimuth = angle_of(y, x) * 114.5915590;
        float column = clamp(azimuth < 0.0 ? azimuth + 720.0 : azimuth, 0.0, 720.0);
        float row = clamp(angle_of(length(vec2(x, y)), z) * 114.5915590, 0.0, 360.0);
        int left = min(int(column), 719), upper = min(int(row), 359), top = 361 * i + upper;
        float u = column - float(left), v = row - float(upper);
        return mix(mix(texelFetch(u_lamp_shares, ivec2(left, top), 0).r,
                       texelFetch(u_lamp_shares, ivec2(left + 1, top), 0).r, u),
                   mix(texelFetch(u_lamp_shares, ivec2(left, top + 1), 0).r,
                       texelFetch(u_lamp_shares, ivec2(left + 1, top + 1), 0).r, u),
                   v);
    }
    return 1.0;
}
#endif

#if ENVIRONMENT
// EnvironmentMap::at: bilinear, wrapping in azimuth, clamped at the poles.
vec3 environment_at(vec3 d) {
    ivec2 size = textureSize(u_environment, 0);
    float column =
        (0.5 - angle_of(d.y, d.x) * 0.15915494309) * float(size.x) - 0.5;
    float row = clamp(angle_of(length(d.xy), d.z) * 0.31830988618 * float(size.y) - 0.5, 0.0,
                      float(size.y) - 1.0);
    float x0 = floor(column), y0 = floor(row), u = column - x0, v = row - y0;
    int x = (int(x0) % size.x + size.x) % size.x, right = (x + 1) % size.x, y = int(y0),
        below = min(y + 1, size.y - 1);
    return mix(mix(texelFetch(u_environment, ivec2(x, y), 0).rgb,
                   texelFetch(u_environment, ivec2(right, y), 0).rgb, u),
               mix(texelFetch(u_environment, ivec2(x, below), 0).rgb,
                   texelFetch(u_environment, ivec2(right, below), 0).rgb, u),
               v);
}
#endif

// The eye's view of the light along a ray beyond `start`, through the end of a path. The nearest
// near light hides all others; distant lights add up.
Weights light_along(vec3 point, vec3 ray, float start, End end, int path) {
    vec3 p = u_light_turn * point, d = u_light_turn * ray;
#if POLARISED_LIGHTS
    end.u = u_light_turn * end.u;
#endif
    float distance;
    int met = near_light(p, d, start, distance);
#if SPHERES + PLANE_LIGHTS > 0
    if (met >= 0) {
        Weights seen = weight_of(met, d, end) * u_radiance[path * LIGHTS + met];
#if LAMPS > 0
        seen *= lamp_share(met, d);
#endif
        return seen;
    }
#endif
    float around = weight_of(LIGHTS, d, end);
    Weights seen = Weights(around * u_constant);
#if ENVIRONMENT
    vec3 rgb = environment_at(d);
    seen += around * (rgb.g + (rgb.r - rgb.g) * u_red[path] + (rgb.b - rgb.g) * u_blue[path]);
#endif
#if LOBES > 0
    for (int i = 0; i < LOBES; ++i) {
        const int number = SPHERES + PLANE_LIGHTS;
        seen += lobe_share(i, d) * weight_of(number + i, d, end) *
                u_radiance[path * LIGHTS + number + i];
    }
#endif
#if CAPS > 0
    for (int i = 0; i < CAPS; ++i) {
        const int number = SPHERES + PLANE_LIGHTS + LOBES;
        vec4 cap = u_caps[2 * i], more = u_caps[2 * i + 1];
        if (in_disc(cap.xyz, d, cap.w, more.x) && !in_disc(cap.xyz, d, more.y, more.z))
            seen += weight_of(number + i, d, end) * u_radiance[path * LIGHTS + number + i];
    }
#endif
    return seen;
}

// ------------------------------------------------------------------------------------- one path

float largest(Weights w) {
#if NODES == 1
    return w;
#elif NODES == 2
    return max(w.x, w.y);
#elif NODES == 3
    return max(max(w.x, w.y), w.z);
#else
    return max(max(w.x, w.y), max(w.z, w.w));
#endif
}

struct EnergyBalance {
    float remainder, absorbed, cut;
    int length;
};

#if CRYSTAL
// A segment of a crystal with merged waves: absorbs each wave, and reduces their coherence (as
// beams/crystal-inl.h, but with a known tangent of the frame). `s`: unit.
vec4 through_crystal(vec4 c, vec3 d, vec3 s, float way, int path) {
    vec3 t = cross(d, s), one = u_optic_axis[2 * path], two = u_optic_axis[2 * path + 1];
    float x1 = dot(one, s), y1 = dot(one, t), x2 = dot(two, s), y2 = dot(two, t);
    // The first wave vibrates across the bisector of the planes through the ray and the optic axes.
    float cosine = y1 * y2 - x1 * x2, sine = -(x1 * y2 + y1 * x2);
    float size = sqrt(cosine * cosine + sine * sine);
    cosine = size > 1e-20 ? cosine / size : 1.0;
    sine = size > 1e-20 ? sine / size : 0.0;
    c = vec4(c.x, cosine * c.y + sine * c.z, cosine * c.z - sine * c.y, c.w);
    float half_cosine = sqrt(max(0.5 + 0.5 * cosine, 0.0)),
          half_sine = sqrt(max(0.5 - 0.5 * cosine, 0.0)) * (sine < 0.0 ? -1.0 : 1.0);
    vec3 first = half_cosine * s + half_sine * t, second = half_cosine * t - half_sine * s;
    vec3 p = vec3(dot(first, u_principal[0]), dot(first, u_principal[1]),
                  dot(first, u_principal[2]));
    vec3 q = vec3(dot(second, u_principal[0]), dot(second, u_principal[1]),
                  dot(second, u_principal[2]));
    float kept1 = exp(-0.5 * way * dot(u_principal_absorption[path], p * p)),
          kept2 = exp(-0.5 * way * dot(u_principal_absorption[path], q * q));
    float power1 = 0.5 * (c.x + c.y) * kept1 * kept1, power2 = 0.5 * (c.x - c.y) * kept2 * kept2;
    vec4 waves = u_waves[path];
    float U = 0.0, V = 0.0;
    if (waves.z > 0.0) {
        // 1/n^2 of both waves from the angles to the optic axes; n_slow - n_fast without
        // cancellation.
        float along1 = dot(one, d), along2 = dot(two, d);
        float sines = sqrt(max((1.0 - along1 * along1) * (1.0 - along2 * along2), 0.0));
        float fast = waves.x + waves.y * (along1 * along2 + sines),
              slow = waves.x + waves.y * (along1 * along2 - sines);
        float root_fast = sqrt(fast), root_slow = sqrt(slow);
        float behind =
            way * 2.0 * waves.y * sines / (root_fast * root_slow * (root_fast + root_slow));
        float turns = behind * waves.z, phase = 6.28318530718 * (turns - floor(turns + 0.5));
        float over = 3.14159265359 * behind * waves.w;
        float sinc = over > 1e-3 ? sin(over) / over : 1.0;
        float left = over < 3.14159265 ? sinc * sinc * kept1 * kept2 : 0.0;
        // E_first E_second*: the second, slow wave is ahead in phase.
        U = left * (cos(phase) * c.z + sin(phase) * c.w);
        V = left * (cos(phase) * c.w - sin(phase) * c.z);
    }
    c = vec4(power1 + power2, power1 - power2, U, V);
    return vec4(c.x, cosine * c.y - sine * c.z, cosine * c.z + sine * c.y, c.w);
}
#endif

#if RESPONSE
// The picture's right axis, turned with the view's axis into a ray.
vec3 eye_right(vec3 ray) {
    return u_right - dot(u_right, ray) / (1.0 + dot(u_forward, ray)) * (u_forward + ray);
}
#endif

// Unit tangent of a face for a ray; `before` if the ray runs along the normal, where any direction
// will do.
vec3 tangent(vec3 d, vec3 n, vec3 before) {
    vec3 s = cross(d, n);
    float squared = dot(s, s);
    return squared > k_straight ? s / sqrt(squared) : before;
}

vec3 any_across(vec3 d) {
    vec3 a = abs(d);
    vec3 other = a.x <= a.y && a.x <= a.z ? vec3(1.0, 0.0, 0.0)
                 : a.y <= a.z             ? vec3(0.0, 1.0, 0.0)
                                          : vec3(0.0, 0.0, 1.0);
    return normalize(cross(d, other));
}

Weights straight(vec3 at, vec3 ray, float eye, int path) {
    End end = End(1.0, 0.0, 0.0, vec3(0.0));
#if RESPONSE
    vec4 row = u_response[path];
    end = End(row.x, row.y, -row.z, eye_right(ray));
#endif
    return light_along(at, ray, eye, end, path);
}

// Magnitude of the carried light, for limits. With a response, the first Stokes parameter may be
// zero.
float size_of(vec4 c) {
#if RESPONSE
    return max(max(abs(c.x), abs(c.y)), max(abs(c.z), abs(c.w)));
#else
    return c.x;
#endif
}

Weights through_stone(vec3 at, vec3 ray, Hit first, int path, out EnergyBalance balance) {
    float n = u_optics[path].x, step = u_optics[path].y, e = u_optics[path].z;
    balance = EnergyBalance(0.0, 0.0, 0.0, 1);
    float unit = 1.0;

    // The first face, from outside.
    float q = min(-dot(ray, first.normal), 1.0);
    Face f = face_of(1.0, e, step, q);
    vec3 s = any_across(ray);
    vec4 c = vec4(1.0, 0.0, 0.0, 0.0);
#if RESPONSE
    // The picture's y points the other way: right x ray instead of ray x right.
    vec4 row = u_response[path];
    c = vec4(row.x, row.y, -row.z, row.w);
    unit = row.x > 0.0 ? 1.0 / row.x : 0.0;
    vec3 right = eye_right(ray);
    s = tangent(ray, first.normal, right);
    c = turned(c, dot(right, s), dot(cross(ray, right), s));
#elif POLARISED
    s = tangent(ray, first.normal, s);
#endif
    vec4 back = reflected(c, f);
    vec3 leaving = mirrored(ray, first.normal);
    Weights tau = Weights(1.0);
    Weights seen = light_along(at, leaving, 0.0, End(back.x, back.y, back.z, s), path);
    if (f.total) return seen;
    c = transmitted(c, f);
#if !POLARISED
    c.y = 0.0;
#endif
    ray = normalize(ray + (q - f.q2) * first.normal);

    for (int faces = 2; faces <= u_depth; ++faces) {
        float weight = size_of(c) * largest(tau);
        if (weight < u_cut || !(weight > 1e-12)) {
            balance.cut = unit * c.x * dot(u_share[path], tau);
            return seen;
        }
        Hit hit = way_out(at, ray);
        at += hit.distance * ray;
        at -= (dot(hit.normal, at) - hit.offset) * hit.normal;
#if CRYSTAL
        float before = c.x;
        c = through_crystal(c, ray, s, hit.distance, path);
        balance.absorbed += unit * (before - c.x) * dot(u_share[path], tau);
#elif ABSORBS
        Weights after = tau * exp(-hit.distance * u_absorption[path]);
        balance.absorbed += unit * c.x * dot(u_share[path], tau - after);
        tau = after;
#endif
        float cosine = dot(ray, hit.normal), q1 = n * cosine;
        f = face_of(e, 1.0, -step, q1);
#if POLARISED
        vec3 next = tangent(ray, hit.normal, s);
        c = turned(c, dot(s, next), dot(cross(ray, s), next));
        s = next;
#endif
        if (!f.total) {
            vec4 out_ = transmitted(c, f);
            leaving = normalize(n * ray + (f.q2 - q1) * hit.normal);
            seen += tau * light_along(at, leaving, 0.0, End(out_.x, out_.y, out_.z, s), path);
            balance.length = faces;
        }
#if POLARISED
        c = reflected(c, f);
#else
        c.x *= 0.5 * (f.Rs + f.Rp);
#endif
        ray = mirrored(ray, hit.normal);
    }
    balance.remainder = unit * c.x * dot(u_share[path], tau);
    return seen;
}

void main() {
    vec3 at = u_at + gl_FragCoord.x * u_at_x + gl_FragCoord.y * u_at_y,
         ray = u_towards + gl_FragCoord.x * u_towards_x + gl_FragCoord.y * u_towards_y;
    float scale = length(ray), eye = -u_eye * scale;
    ray /= scale;
    Hit first = entry(at, ray);
    // Near lights in front of the stone hide it.
    float before;
    near_light(u_light_turn * at, u_light_turn * ray, eye, before);
    bool meets = first.distance < k_infinite && first.distance >= eye && !(before < first.distance);
    vec3 rgb = vec3(0.0), lost = vec3(0.0);
    int longest = 0;
    vec3 entered = at + first.distance * ray;
    entered -= (dot(first.normal, entered) - first.offset) * first.normal;
    for (int path = 0; path < u_paths; ++path) {
        EnergyBalance balance = EnergyBalance(0.0, 0.0, 0.0, 0);
        Weights seen;
        if (meets) {
            seen = through_stone(entered, ray, first, path, balance);
        } else {
            seen = straight(at, ray, eye, path);
        }
#if NODES == 1
        rgb += seen * u_colour[path];
#else
        for (int node = 0; node < NODES; ++node) rgb += seen[node] * u_colour[NODES * path + node];
#endif
        lost += vec3(balance.remainder, balance.absorbed, balance.cut);
        longest = max(longest, balance.length);
    }
    out_sum = vec4(rgb, meets ? 1.0 : 0.0);
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    if (u_keep > 0.0) out_sum += u_keep * texelFetch(u_sum, pixel, 0);
#if BALANCE
    out_balance = vec4(lost, meets ? dot(rgb, u_luminance) : 0.0);
    out_length = float(longest);
    if (u_keep > 0.0) {
        out_balance += u_keep * texelFetch(u_balance, pixel, 0);
        out_length = max(out_length, texelFetch(u_length, pixel, 0).r);
    }
#endif
}
