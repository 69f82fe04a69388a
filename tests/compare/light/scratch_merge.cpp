#include <cstdio>
#include <ctime>
#include "compare/light/light_probe.h"
#include "render/environment_layout.h"
#include "render/image_io.h"
#include "tests/compare/light/simulated_ball.h"
using namespace culet;
int main(int argc, char** argv) {
    const std::string what = argv[1];
    const double radius = atof(argv[2]);
    EnvironmentMap map;
    auto p = read_picture(what).picture;
    map.width = p.width; map.height = p.height; map.rgb = p.rgb;
    for (auto& v : map.rgb) v = std::max(v, 0.f);
    for (int h = 1; h < 2; ++h) { EnvironmentMap s; s.width = map.width / 2; s.height = map.height / 2; s.rgb.resize(3 * size_t(s.width) * s.height); for (int y = 0; y < s.height; ++y) for (int x = 0; x < s.width; ++x) for (int c = 0; c < 3; ++c) { float v = 0; for (int k = 0; k < 4; ++k) v += map.rgb[3 * ((2 * y + k / 2) * size_t(map.width) + 2 * x + k % 2) + c]; s.rgb[3 * (size_t(y) * s.width + x) + c] = v / 4; } map = s; }
    auto pano = simulated::panorama_of(map);
    std::vector<BallView> views;
    for (int v = 0; v < 2; ++v) {
        simulated::BallShot s;
        s.radius = radius; s.width = int(radius * 2.1); s.height = int(radius * 2.1);
        s.centre_x = (s.width - 1) / 2.0; s.centre_y = (s.height - 1) / 2.0; s.reflectance = 1;
        s.world_from_camera = simulated::camera_at(v * M_PI / 2, 0);
        auto t = simulated::take(s, pano);
        views.push_back({std::make_shared<Photo>(t.photo), MirrorBall::at_distance({s.centre_x, s.centre_y, radius}, {s.centre_x, s.centre_y}, 20), PhotographerCone{}, s.world_from_camera});
    }
    for (int width : {512})
    for (int passes : {0, 3, 10, 30}) {
        const double t0 = clock();
        auto merged = merge_views(views, {1, 1}, width, passes);
        auto& m = merged.map;
        struct E { double s, om, theta; };
        std::vector<E> errs; double sum = 0, tot = 0, e0 = 0, e1 = 0;
        double band[6] = {}, bandw[6] = {}, worstw[6] = {};
        for (int y = 0; y < m.height; ++y) {
            double om = lat_long_solid_angle(y, m.width, m.height);
            for (int x = 0; x < m.width; ++x) {
                Rgb truth{};
                const int n = 1; for (int c = 0; c < 3; ++c) truth[c] = map.rgb[3 * (size_t(y) * m.width + x) + c];
                for (int k = 0; k < 0; ++k) { Rgb t = pano(lat_long_direction(x + (k % n + .5) / n, y + (k / n + .5) / n, m.width, m.height)); for (int c = 0; c < 3; ++c) truth[c] += t[c] / (n * n); }
                const float* g = &m.rgb[3 * (size_t(y) * m.width + x)];
                double lt = 0.2126 * truth[0] + .7152 * truth[1] + .0722 * truth[2], lg = 0.2126 * g[0] + .7152 * g[1] + .0722 * g[2];
                e0 += om * lt; e1 += om * lg;
                double s = std::abs(std::log2((lg + 1e-6) / (lt + 1e-6)));
                Vec3 d = lat_long_direction(x + .5, y + .5, m.width, m.height);
                double th = std::min(std::acos(-d.x), std::acos(-d.y)) * 57.3;
                int b = std::min(5, int(th / 30)); band[b] += om * s; bandw[b] += om; if (s > 0.2) worstw[b] += om;
                sum += om * s; tot += om; errs.push_back({s, om, th});
            }
        }
        std::sort(errs.begin(), errs.end(), [](auto& a, auto& b) { return a.s > b.s; });
        double acc = 0, p99 = 0;
        for (auto& e : errs) { acc += e.om; if (!p99 && acc > 0.01 * tot) p99 = e.s; }
        printf("R %.0f w %d passes %2d %.1f s: mean %.4f p99 %.3f energy %.5f | by theta:", radius, width, passes, (clock() - t0) / CLOCKS_PER_SEC, sum / tot, p99, e1 / e0);
        for (int b = 0; b < 6; ++b) if (bandw[b] > 0) printf(" %d: %.4f (%.2f%% >.2)", b * 30, band[b] / bandw[b], 100 * worstw[b] / bandw[b]);
        printf("\n"); fflush(stdout);
    }
}
