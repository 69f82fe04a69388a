// Cases of kind "face": one face between two isotropic media. Expectations: Fresnel's formulas in
// 100 digits, for the same doubles as culet's.
//
// [face]: n1, n2; `at` = critical | grazing | brewster | normal | angle_deg; `past`: radians beyond
// that angle of incidence (negative: before it). `at` = q: the normal component of the wave vector
// itself, `q` times that of the critical angle.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>

#include "render/optics/fresnel.h"
#include "tests/hard/hard_kinds.h"
#include "tests/hard/hard_solids.h"
#include "tests/hard/textbook.h"
#include "tests/render/oracle_numbers.h"

namespace culet::hard {

namespace {

using oracle::Number;
using oracle::Real;

struct ExactFace {
    Number r_s, r_p;
    Real t_s, t_p;  // of unit flux
    Real R_s, R_p, T_s, T_p;
};

ExactFace exact_face(const Real& n1, const Real& n2, const Real& q1) {
    const Real e1 = n1 * n1, e2 = n2 * n2;
    const Real q2_squared = e2 - e1 + q1 * q1;
    const Real root = sqrt(abs(q2_squared));
    const Number q2 = q2_squared >= 0 ? Number(root, 0) : Number(0, root);
    ExactFace face;
    face.r_s = q1 + root == 0 ? Number(-1) : (Number(q1) - q2) / (Number(q1) + q2);
    face.r_p = q1 + root == 0
                   ? Number(-1)
                   : (Number(e2 * q1) - Number(e1) * q2) / (Number(e2 * q1) + Number(e1) * q2);
    if (q2_squared > 0) {
        face.t_s = 2 * sqrt(q1 * root) / (q1 + root);
        face.t_p = 2 * n1 * n2 * sqrt(q1 * root) / (e2 * q1 + e1 * root);
    }
    face.R_s = oracle::norm_of(face.r_s);
    face.R_p = oracle::norm_of(face.r_p);
    face.T_s = face.t_s * face.t_s;
    face.T_p = face.t_p * face.t_p;
    return face;
}

struct FaceCase {
    double n1 = 1, n2 = 1, q1 = 0;
    ExactFace truth, nudged[6];
    FaceAmplitudes found;
};

double amplitude_distance(const ExactFace& a, const ExactFace& b) {
    const auto apart = [](const Number& x) {
        return static_cast<double>(sqrt(oracle::norm_of(x)));
    };
    return std::max({apart(a.r_s - b.r_s), apart(a.r_p - b.r_p),
                     static_cast<double>(abs(a.t_s - b.t_s)),
                     static_cast<double>(abs(a.t_p - b.t_p))});
}

double relative_distance(const ExactFace& a, const ExactFace& b) {
    double worst = 0;
    for (const auto& [x, y] : {std::pair(a.R_s, b.R_s), std::pair(a.R_p, b.R_p),
                               std::pair(a.T_s, b.T_s), std::pair(a.T_p, b.T_p)}) {
        if (y == 0 && x == 0) continue;
        worst = std::max(worst, y == 0 ? 1.0 : static_cast<double>(abs(x / y - 1)));
    }
    return worst;
}

ExactFace exact_of(const FaceAmplitudes& found) {
    ExactFace face;
    face.r_s = Number(Real(found.r_s.real()), Real(found.r_s.imag()));
    face.r_p = Number(Real(found.r_p.real()), Real(found.r_p.imag()));
    face.t_s = found.t_s;
    face.t_p = found.t_p;
    face.R_s = oracle::norm_of(face.r_s);
    face.R_p = oracle::norm_of(face.r_p);
    face.T_s = face.t_s * face.t_s;
    face.T_p = face.t_p * face.t_p;
    return face;
}

template <class Distance>
Measured against_truth(const FaceCase& c, Distance distance) {
    Measured m;
    m.error = distance(exact_of(c.found), c.truth);
    double sensitivity = 0;
    for (const ExactFace& n : c.nudged) sensitivity = std::max(sensitivity, distance(n, c.truth));
    m.condition = sensitivity / 2.220446049250313e-16;
    m.about = fmt::format("n1 {:.17g}, n2 {:.17g}, q1 {:.17g}", c.n1, c.n2, c.q1);
    return m;
}

FaceCase make_case(const TomlTable& face) {
    face.refuse_unknown({"n1", "n2", "at", "past", "q"});
    FaceCase c;
    c.n1 = face.number("n1").value_or(1);
    c.n2 = face.number("n2").value_or(1.5);
    const Real n1 = c.n1, n2 = c.n2;
    const std::string at = face.text("at").value_or("normal");
    const Real past = face.number("past").value_or(0);
    const Real right = acos(Real(0));
    Real angle = 0;
    if (at == "critical") {
        if (c.n2 > c.n1) face.fail("at", "there is no critical angle from the thinner side");
        angle = asin(n2 / n1);
    } else if (at == "grazing") {
        angle = right;
    } else if (at == "brewster") {
        angle = atan(n2 / n1);
    } else if (at == "q") {
        const Real of_critical = sqrt(abs(n1 * n1 - n2 * n2));
        c.q1 = static_cast<double>(Real(face.number("q").value_or(1)) * of_critical);
    } else if (at != "normal") {
        face.fail("at", "is none of critical, grazing, brewster, normal, q");
    }
    if (at != "q") c.q1 = static_cast<double>(n1 * cos(angle + past));
    c.q1 = std::clamp(c.q1, 0.0, c.n1);
    c.found = fresnel(c.n1, c.n2, c.q1);
    c.truth = exact_face(c.n1, c.n2, c.q1);
    const double h = 2.220446049250313e-16;
    const int signs[6][3] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    for (int k = 0; k < 6; ++k) {
        const Real q = Real(c.q1) * (1 + signs[k][2] * Real(h));
        const Real n = Real(c.n1) * (1 + signs[k][0] * Real(h));
        c.nudged[k] = exact_face(n, Real(c.n2) * (1 + signs[k][1] * Real(h)), q > n ? n : q);
    }
    return c;
}

}  // namespace

Subject face_subject(const HardCase&, const HardPoint&, const TomlTable& parameters) {
    const auto c = std::make_shared<FaceCase>(make_case(parameters.table("face").value()));
    Subject subject;
    auto& is = subject.invariants;
    is["amplitudes"] = [c] { return against_truth(*c, amplitude_distance); };
    is["relative_powers"] = [c] { return against_truth(*c, relative_distance); };
    is["energy"] = [c] {
        const FaceAmplitudes& f = c->found;
        return Measured{std::max(std::abs(std::norm(f.r_s) + f.t_s * f.t_s - 1),
                                 std::abs(std::norm(f.r_p) + f.t_p * f.t_p - 1)),
                        std::nan(""), ""};
    };
    // Reciprocity: the transmission is the same in both directions.
    is["reversed"] = [c] {
        if (c->found.total) return Measured{};
        const FaceAmplitudes back = fresnel(c->n2, c->n1, c->found.q2);
        // The effect of the last place of q2 on the reverse path: nearly everything at grazing.
        double sensitivity = 0;
        for (const int sign : {-1, 1}) {
            const Real q2 = sqrt(Real(c->n2) * c->n2 - Real(c->n1) * c->n1 + Real(c->q1) * c->q1) *
                            (1 + sign * Real(2.220446049250313e-16));
            sensitivity =
                std::max(sensitivity,
                         amplitude_distance(exact_face(c->n2, c->n1, q2 > c->n2 ? Real(c->n2) : q2),
                                            exact_face(c->n2, c->n1, Real(c->found.q2))));
        }
        return Measured{
            std::max(std::abs(back.t_s - c->found.t_s), std::abs(back.t_p - c->found.t_p)),
            sensitivity / 2.220446049250313e-16, ""};
    };
    is["finite"] = [c] {
        // A sane call: same numbers, no NaN, no invalid operation.
        const FaceAmplitudes f = fresnel(c->n1, c->n2, c->q1);
        const bool finite = std::isfinite(std::abs(f.r_s)) && std::isfinite(std::abs(f.r_p)) &&
                            std::isfinite(f.t_s) && std::isfinite(f.t_p) && std::isfinite(f.q2);
        return Measured{finite ? 0.0 : 1.0, std::nan(""), ""};
    };
    subject.contrasts.push_back(
        {"relative_powers", "1 − η²(1 − c²), T = 1 − R", [c] {
             const FacePowers p = textbook_face(c->n1, c->n2, c->q1 / c->n1);
             ExactFace face;
             face.R_s = p.R_s;
             face.R_p = p.R_p;
             face.T_s = p.T_s;
             face.T_p = p.T_p;
             return Measured{relative_distance(face, c->truth), std::nan(""), ""};
         }});
    return subject;
}

}  // namespace culet::hard
