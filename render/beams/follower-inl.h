// Follows rays along the facets of a beam, many at once. No include guard: Highway includes this
// once per instruction set.

HWY_BEFORE_NAMESPACE();
namespace culet {
namespace HWY_NAMESPACE {

// The picture's right axis, turned with the view's axis into a ray.
HWY_INLINE V3 eye_right(const ShadedEye& eye, const V3& direction) {
    const V3 forward = vector(eye.forward), right = vector(eye.right);
    return plus(right, hn::Neg(dot(right, direction)) / (number(1.0f) + dot(forward, direction)),
                forward + direction);
}

HWY_INLINE PixelPart part_of(const Fragments& fragments, int first) {
    if (fragments.xx == nullptr) return {number(1.0f), number(0.0f), number(1.0f)};
    return {hn::LoadU(k_floats, fragments.xx + first), hn::LoadU(k_floats, fragments.yx + first),
            hn::LoadU(k_floats, fragments.yy + first)};
}

// kGeneral: polarised lights, the eye's response, merged crystals.
template <bool kPolarised, bool kSoft, bool kMany, bool kGeneral>
class Follower {
public:
    HWY_INLINE Follower(const ShadingJob& job, const ShadedEye& eye, const std::uint16_t* facets,
                        int facet_count, const Fragments& out)
        : stone_(*job.stone),
          optics_(*job.optics),
          lights_(*job.lights),
          eye_(eye),
          facets_(facets),
          facet_count_(facet_count),
          out_(out) {}

    HWY_INLINE void follow(int first) {
        const V dx = hn::LoadU(k_floats, out_.x + first), dy = hn::LoadU(k_floats, out_.y + first);
        const int nodes = kMany ? lights_.nodes : 1;
        for (int i = 0; i < nodes; ++i) {
            sum_[i] = number(0.0f);
            tau_[i] = number(1.0f);
        }
        parts_ = out_.xx != nullptr ? &out_ : nullptr;
        first_ = first;
        enter(dx, dy, part_of(out_, first));
        const bool located =
            kMany ? true
                  : out_.verified != nullptr || !lights_.spheres.empty() || !lights_.planes.empty();
        V absorbed = number(0.0f);
        for (int k = 1; k < facet_count_; ++k) {
            const ShadedStone::Face& face = stone_.faces[facets_[k]];
            const V3 a{number(face.x), number(face.y), number(face.z)};
            const V cosine = dot(a, ray_.direction);
            if (located) {
                // Rays beside the beam may miss its facets: limit them to the longest way in the
                // stone.
                const V towards = hn::Max(cosine, number(1e-4f));
                const V farthest = number(stone_.size);
                const V length =
                    hn::Min(hn::Max((number(face.offset) - dot(a, ray_.point)) / towards,
                                    hn::Neg(farthest)),
                            farthest);
                ray_.point = plus(ray_.point, length, ray_.direction);
                if constexpr (kSoft) {
                    move(ray_.point_x, ray_.direction_x, length, a, towards);
                    move(ray_.point_y, ray_.direction_y, length, a, towards);
                }
                if constexpr (kMany) absorb(length, absorbed);
                if constexpr (kGeneral) {
                    if (optics_.crystal) {
                        const ShadedStone::Face& was = stone_.faces[facets_[k - 1]];
                        absorbed =
                            absorbed + go_through(*optics_.crystal, ray_.direction,
                                                  {number(was.x), number(was.y), number(was.z)},
                                                  length, carried_);
                    }
                }
                if (out_.verified != nullptr)
                    verified_ = hn::And(verified_, hn::And(cosine > number(0.0f), on_facet(face)));
            }
            if constexpr (kPolarised) turn(cosine, k);
            meet(a, cosine);
            // Rays beside the beam may lose all light along its facets: avoid slow denormals.
            V most = hn::Abs(carried_.I);
            if constexpr (kGeneral) {
                // The first Stokes parameter of a response may be zero.
                most = hn::Max(hn::Max(most, hn::Abs(carried_.Q)),
                               hn::Max(hn::Abs(carried_.U), hn::Abs(carried_.V_)));
            }
            const M alive = most > number(1e-12f);
            if (hn::AllFalse(k_floats, alive)) {
                carried_.I = number(0.0f);
                break;
            }
            carried_.I = hn::IfThenElseZero(alive, carried_.I);
            carried_.Q = hn::IfThenElseZero(alive, carried_.Q);
            carried_.U = hn::IfThenElseZero(alive, carried_.U);
            carried_.V_ = hn::IfThenElseZero(alive, carried_.V_);
        }
        for (int i = 0; i < nodes; ++i)
            hn::StoreU(
                sum_[i] * uncovered_, k_floats,
                out_.radiance + static_cast<size_t>(i) * static_cast<size_t>(out_.stride) + first);
        hn::StoreU(remaining() * uncovered_, k_floats, out_.left + first);
        if (out_.unhidden != nullptr) {
            hn::StoreU(uncovered_, k_floats, out_.unhidden + first);
            for (int i = 0; i < nodes; ++i)
                hn::StoreU(before_[i], k_floats,
                           out_.before + static_cast<size_t>(i) * static_cast<size_t>(out_.stride) +
                               first);
        }
        if (k_has_effects && out_.absorbed != nullptr)
            hn::StoreU(absorbed * uncovered_, k_floats, out_.absorbed + first);
        if (out_.verified != nullptr)
            hn::StoreU(hn::IfThenElseZero(verified_, number(1.0f)), k_floats,
                       out_.verified + first);
    }

private:
    HWY_INLINE V remaining() const {
        if constexpr (!kMany) {
            return carried_.I;
        } else {
            V mean = number(0.0f);
            for (int i = 0; i < lights_.nodes; ++i) mean = mean + tau_[i];
            return carried_.I * mean / number(static_cast<float>(lights_.nodes));
        }
    }

    HWY_INLINE M on_facet(const ShadedStone::Face& face) const {
        const ShadedStone::Side* side = stone_.sides.data() + face.first_side;
        V most = number(-1.0f);
        for (std::uint32_t i = 0; i < face.sides; ++i, ++side) {
            const V3 across{number(side->x), number(side->y), number(side->z)};
            most = hn::Max(most, dot(across, ray_.point) - number(side->offset));
        }
        // Inside by more than rounding errors over a long path; rays closer to a side are retraced.
        return most <= number(-1e-6f * stone_.size);
    }

    // How far a neighbouring ray's point moves along its ray into the plane. Rays beside the beam
    // hardly meet its facets; the clamp keeps their shifts from growing into NaN.
    HWY_INLINE V into_plane(const V3& moved, const V3& a, const V& towards) const {
        const V farthest = number(1e6f * stone_.size);
        return hn::Clamp(hn::Neg(dot(a, moved)) / towards, hn::Neg(farthest), farthest);
    }
    // Change of the next point, within the plane.
    HWY_INLINE void move(V3& point, const V3& direction_change, const V& length, const V3& a,
                         const V& towards) {
        const V3 moved = plus(point, length, direction_change);
        point = plus(moved, into_plane(moved, a, towards), ray_.direction);
    }

    HWY_INLINE void absorb(const V& length, V& absorbed) {
        if (optics_.absorption.empty()) return;
        V lost = number(0.0f);
        for (int i = 0; i < lights_.nodes; ++i) {
            const V after =
                tau_[i] * decayed(hn::Neg(number(optics_.absorption[static_cast<size_t>(i)])) *
                                  hn::Max(length, number(0.0f)));
            lost = lost + tau_[i] - after;
            tau_[i] = after;
        }
        absorbed =
            hn::MulAdd(carried_.I / number(static_cast<float>(lights_.nodes)), lost, absorbed);
    }

    // Adds the light at the end of a path of weight `weight`; `end` holds its polarisation.
    HWY_INLINE void add_exit_light(const V& weight, const Ray& out, PathWeight& end) {
        if constexpr (kMany) {
            V weights[k_band_nodes];
            for (int i = 0; i < lights_.nodes; ++i) weights[i] = weight * tau_[i];
            if (end.polarised) {
                end.Q = end.Q * tau_[0];
                end.U = end.U * tau_[0];
            }
            end.weight = weights;
            Gather<kMany> gather{lights_, sum_, end};
            all_light<kSoft>(lights_, out, gather);
        } else {
            end.weight = &weight;
            Gather<kMany> gather{lights_, sum_, end};
            all_light<kSoft>(lights_, out, gather);
        }
    }

    // Sets Q and U of light that leaves through a face, for the tangent `s` of any length.
    HWY_INLINE void polarise(PathWeight& end, const V& Q, const V& U, const V3& direction,
                             const V3& s) const {
        end.polarised = true;
        end.Q = Q;
        end.U = U;
        end.direction = direction;
        const V square = dot(s, s);
        const M any = square > number(1e-24f);
        const V scale = number(1.0f) / hn::Sqrt(hn::IfThenElse(any, square, number(1.0f)));
        end.u = scale * s;
        end.v = cross(direction, end.u);
    }

    // Brings the eye ray through a pixel to the first face and through it.
    HWY_INLINE void enter(const V& dx, const V& dy, const PixelPart& part) {
        const ShadedStone::Face& face = stone_.faces[facets_[0]];
        const V3 N{number(face.x), number(face.y), number(face.z)};
        const V3 vx = vector(eye_.direction_x), vy = vector(eye_.direction_y);
        const V3 gx = vector(eye_.point_x), gy = vector(eye_.point_y);
        const V3 v = plus(plus(vector(eye_.direction), dx, vx), dy, vy);
        const V3 shift = dx * gx + dy * gy;
        const V towards = hn::Min(dot(N, v), number(-1e-20f));
        const V later = hn::Neg(dot(N, shift)) / towards;
        ray_.point = plus(vector(eye_.point) + shift, later, v);
        const V length = hn::Sqrt(dot(v, v)), over = number(1.0f) / length;
        const V3 along = over * v;
        const V q1 = hn::Min(hn::Neg(towards) * over, number(1.0f));
        const float n = optics_.n;
        const V q2 = hn::Sqrt(hn::MulAdd(q1, q1, number((n - 1) * (n + 1))));
        const V bend = q1 - q2, over_n = number(1.0f / n);
        ray_.direction = over_n * plus(along, bend, N);
        verified_ = hn::And(towards < number(0.0f), on_facet(face));

        Ray mirrored{ray_.point, plus(along, q1 + q1, N), ray_.point, ray_.point, N, N, parts_,
                     first_};
        if constexpr (kSoft) {
            const auto change = [&](const V3& g, const V3& dv, V3& point, V3& inside,
                                    V3& outside) HWY_ATTR {
                const V3 moved = plus(g, later, dv);
                point = plus(moved, into_plane(moved, N, towards), v);
                const V3 turned = over * plus(dv, hn::Neg(dot(along, dv)), along);
                const V dq1 = hn::Neg(dot(N, turned)), dq2 = q1 * dq1 / q2;
                inside = over_n * plus(turned, dq1 - dq2, N);
                outside = plus(turned, dq1 + dq1, N);
            };
            change(part.along(gx, gy), part.along(vx, vy), ray_.point_x, ray_.direction_x,
                   mirrored.direction_x);
            change(part.across(gy), part.across(vy), ray_.point_y, ray_.direction_y,
                   mirrored.direction_y);
            mirrored.point_x = ray_.point_x;
            mirrored.point_y = ray_.point_y;
        }

        // Near lights in front of the stone.
        uncovered_ = number(1.0f);
        const int nodes = kMany ? lights_.nodes : 1;
        for (int i = 0; i < nodes; ++i) before_[i] = number(0.0f);
        if (out_.unhidden != nullptr) {
            const V distance = (number(eye_.distance) + later) * length;
            Ray from_eye{
                plus(ray_.point, hn::Neg(distance), along), along, gx, gy, vx, vy, parts_, first_};
            if constexpr (kSoft) {
                const auto turned = [&](const V3& change) HWY_ATTR {
                    return over * plus(change, hn::Neg(dot(along, change)), along);
                };
                const V3 origin_x = vector(eye_.origin_x), origin_y = vector(eye_.origin_y);
                from_eye.point_x = part.along(origin_x, origin_y);
                from_eye.point_y = part.across(origin_y);
                from_eye.direction_x = turned(part.along(vx, vy));
                from_eye.direction_y = turned(part.across(vy));
            }
            V one[k_band_nodes];
            for (int i = 0; i < nodes; ++i) one[i] = number(1.0f);
            PathWeight direct{};
            direct.weight = one;
            if constexpr (kGeneral) {
                if (optics_.response) one[0] = number((*optics_.response)[0]);
                direct.polarised = true;
                direct.Q = number(optics_.response ? (*optics_.response)[1] : 0.0f);
                direct.U = number(optics_.response ? -(*optics_.response)[2] : 0.0f);
                direct.direction = along;
                direct.u = eye_right(eye_, along);
                direct.v = cross(along, direct.u);
            }
            Gather<kMany> gather{lights_, before_, direct};
            uncovered_ = near_light<kSoft>(lights_, from_eye, distance, gather);
        }

        const V e2 = number(n * n);
        const V r_s = bend / (q1 + q2), r_p = (e2 * q1 - q2) / (e2 * q1 + q2);
        const V R_s = r_s * r_s, R_p = r_p * r_p, half = number(0.5f), one = number(1.0f);
        const V R = half * (R_s + R_p), D = half * (R_s - R_p);
        PathWeight end{};
        if constexpr (kGeneral) {
            // Stokes parameters of the eye's response, in the face's frame.
            carried_ = {one, number(0.0f), number(0.0f), number(0.0f)};
            const V3 s = cross(along, N);
            if (optics_.response) {
                const auto& row = *optics_.response;
                // The picture's y points the other way: right x ray instead of ray x right.
                carried_ = {number(row[0]), number(row[1]), number(-row[2]), number(row[3])};
                const V3 right = eye_right(eye_, along);
                const DoubleAngle turned(dot(right, s), dot(cross(along, right), s));
                carried_.turn(turned.cosine, turned.sine);
            }
            const Carried was = carried_;
            polarise(end, hn::MulAdd(D, was.I, R * was.Q), r_s * r_p * was.U, mirrored.direction,
                     tangent_or_any(s, along));
            add_exit_light(hn::MulAdd(R, was.I, D * was.Q), mirrored, end);
            // t_s t_p from the powers.
            const V both = hn::Sqrt(hn::Max((one - R_s) * (one - R_p), number(0.0f)));
            carried_ = {hn::NegMulAdd(D, was.Q, (one - R) * was.I),
                        hn::NegMulAdd(D, was.I, (one - R) * was.Q), both * was.U, both * was.V_};
        } else {
            add_exit_light(R, mirrored, end);
            carried_.I = one - R;
            carried_.Q = hn::Neg(D);
            carried_.U = number(0.0f);
            carried_.V_ = number(0.0f);
        }
        // Cosine with the face before, for `turn`.
        cosine_before_ = hn::Neg(q2) * over_n;
    }

    HWY_INLINE V3 tangent_or_any(const V3& s, const V3& d) const {
        const M oblique = dot(s, s) > number(1e-20f);
        return hn::AllTrue(k_floats, oblique) ? s : any_tangent(s, d, oblique);
    }
    // Rotates from the tangent d x b of the face before to the tangent d x a of this one.
    HWY_INLINE void turn(const V& cosine, int k) {
        const ShadedStone::Face &now = stone_.faces[facets_[k]],
                                &was = stone_.faces[facets_[k - 1]];
        const float ab = now.x * was.x + now.y * was.y + now.z * was.z;
        const V3 cross_ab{number(was.y * now.z - was.z * now.y),
                          number(was.z * now.x - was.x * now.z),
                          number(was.x * now.y - was.y * now.x)};
        const DoubleAngle angle(number(ab) - cosine * cosine_before_,
                                dot(ray_.direction, cross_ab));
        carried_.turn(angle.cosine, angle.sine);
    }

    HWY_INLINE void meet(const V3& a, const V& cosine) {
        const float n = optics_.n;
        const V e = number(n * n), one = number(1.0f), half = number(0.5f), zero = number(0.0f);
        // Never 0, as 0 / 0 is an invalid operation. Rays that miss the facet do not use it.
        const V q1 = number(n) * hn::Max(cosine, number(1e-20f));
        const V q2_squared = hn::MulAdd(q1, q1, number(-(n - 1) * (n + 1)));
        const M out = q2_squared > zero;
        V R_s = one, R_p = one, re = one, im = zero;
        const bool any_out = !hn::AllFalse(k_floats, out);
        if (any_out) {
            const V q2 = hn::Sqrt(hn::Max(q2_squared, zero));
            const V r_s = (q1 - q2) / (q1 + q2), r_p = (q1 - e * q2) / hn::MulAdd(e, q2, q1);
            R_s = hn::IfThenElse(out, r_s * r_s, one);
            R_p = hn::IfThenElse(out, r_p * r_p, one);
            re = hn::IfThenElse(out, r_s * r_p, one);
            Ray leaving{ray_.point,       plus(number(n) * ray_.direction, q2 - q1, a),
                        ray_.point_x,     ray_.point_y,
                        ray_.direction_x, ray_.direction_y,
                        parts_,           first_};
            if constexpr (kSoft) {
                const V slope = q1 / hn::Max(q2, number(1e-6f));
                const auto change = [&](const V3& inside) HWY_ATTR {
                    const V3 turned = number(n) * inside;
                    const V dq1 = dot(a, turned);
                    return plus(turned, dq1 * slope - dq1, a);
                };
                leaving.direction_x = change(ray_.direction_x);
                leaving.direction_y = change(ray_.direction_y);
            }
            V weight = (one - half * (R_s + R_p)) * carried_.I;
            if constexpr (kPolarised) weight = weight + half * (R_p - R_s) * carried_.Q;
            PathWeight end{};
            if constexpr (kGeneral) {
                const V T = one - half * (R_s + R_p), D = half * (R_p - R_s);
                const V both = hn::Sqrt(hn::Max((one - R_s) * (one - R_p), zero));
                polarise(end, hn::IfThenElseZero(out, hn::MulAdd(D, carried_.I, T * carried_.Q)),
                         hn::IfThenElseZero(out, both * carried_.U), leaving.direction,
                         tangent_or_any(cross(ray_.direction, a), leaving.direction));
            }
            add_exit_light(hn::IfThenElseZero(out, weight), leaving, end);
        }
        if constexpr (kPolarised) {
            if (!hn::AllTrue(k_floats, out)) {
                // r_s r_p* of total reflection: twice the phase of A + i B.
                const V kappa = hn::Sqrt(hn::Max(hn::Neg(q2_squared), zero));
                const V A = hn::MulAdd(e * kappa, kappa, q1 * q1),
                        B = number((n - 1) * (n + 1)) * kappa * q1;
                const V AA = A * A, BB = B * B, scale = one / hn::Max(AA + BB, number(1e-30f));
                re = hn::IfThenElse(out, re, (AA - BB) * scale);
                im = hn::IfThenElse(out, zero, (A + A) * B * scale);
            }
            if (any_out) {
                const V sum = half * (R_s + R_p), difference = half * (R_s - R_p), I = carried_.I;
                carried_.I = hn::MulAdd(sum, I, difference * carried_.Q);
                carried_.Q = hn::MulAdd(difference, I, sum * carried_.Q);
            }
            const V U = carried_.U;
            carried_.U = hn::MulSub(re, U, im * carried_.V_);
            carried_.V_ = hn::MulAdd(im, U, re * carried_.V_);
        } else {
            carried_.I = carried_.I * half * (R_s + R_p);
        }
        const V twice = hn::Neg(cosine + cosine);
        ray_.direction = plus(ray_.direction, twice, a);
        if constexpr (kSoft) {
            const auto mirror = [&](const V3& change) HWY_ATTR {
                const V c = dot(a, change);
                return plus(change, hn::Neg(c + c), a);
            };
            ray_.direction_x = mirror(ray_.direction_x);
            ray_.direction_y = mirror(ray_.direction_y);
        }
        cosine_before_ = hn::Neg(cosine);
    }

    const ShadedStone& stone_;
    const ShadedOptics& optics_;
    const ShadedLights& lights_;
    const ShadedEye& eye_;
    const std::uint16_t* facets_;
    int facet_count_;
    const Fragments& out_;
    const Fragments* parts_ = nullptr;
    int first_ = 0;
    Ray ray_;
    Carried carried_;
    V cosine_before_, uncovered_;
    M verified_;
    V sum_[kMany ? k_band_nodes : 1], tau_[kMany ? k_band_nodes : 1],
        before_[kMany ? k_band_nodes : 1];
};

template <bool kPolarised, bool kSoft, bool kMany, bool kGeneral>
void follow_all(const ShadingJob& job, const ShadedEye& eye, const std::uint16_t* facets,
                int facet_count, const Fragments& fragments) {
    Follower<kPolarised, kSoft, kMany, kGeneral> follower(job, eye, facets, facet_count, fragments);
    const int lanes = static_cast<int>(hn::Lanes(k_floats));
    for (int i = 0; i < fragments.count; i += lanes) follower.follow(i);
}

// Uses the simplest variant that covers the scene's optics.
template <bool kPolarised, bool kSoft>
void follow_beam(const ShadingJob& job, const ShadedEye& eye, const std::uint16_t* facets,
                 int facet_count, const Fragments& fragments) {
    auto* follow = follow_all<kPolarised, kSoft, false, false>;
    if constexpr (k_has_effects) {
        if (job.lights->nodes > 1 || !job.optics->absorption.empty())
            follow = follow_all<kPolarised, kSoft, true, false>;
        if constexpr (kPolarised) {
            if (job.optics->crystal || job.optics->response)
                follow = follow_all<true, kSoft, true, true>;
        }
    }
    follow(job, eye, facets, facet_count, fragments);
}

}  // namespace HWY_NAMESPACE
}  // namespace culet
HWY_AFTER_NAMESPACE();
