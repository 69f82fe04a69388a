#include "render/plan/beam_proposal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace culet {
namespace {

// A diamond's proposal, of random errors that fall from choice to choice.
BeamProposal random_proposal(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> falls(0.2, 0.9);
    BeamProposal proposal;
    double error = 0.2;
    for (double weight = 0.3; weight > 1e-4; weight /= 3)
        proposal.cuts.push_back({weight, error *= falls(random), 0, 0});
    error = 0.2;
    for (const int count : {1, 3, 5, 8, 15, 29})
        proposal.sets.push_back({count, error *= falls(random), 0, 0});
    proposal.effects = 0.01;
    proposal.pixels = 30000;
    proposal.events_per_ray = 12;
    proposal.dispersed = true;
    return proposal;
}

// What may be off by more is never dearer; what is proposed keeps to the room where anything does.
TEST(BeamProposal, costs_no_more_where_more_is_allowed) {
    for (unsigned seed = 0; seed < 50; ++seed) {
        SCOPED_TRACE(seed);
        const BeamProposal proposal = random_proposal(seed);
        double before = std::numeric_limits<double>::infinity();
        for (double room = 0.005; room < 0.5; room *= 1.5) {
            const ProposedBeams beams = proposal.cheapest(room);
            ASSERT_GT(beams.price_ns, 0);
            if (beams.error > room) {
                // None does: it is one that is likely off by about the least.
                EXPECT_EQ(beams.error, proposal.cheapest(0).error);
                continue;
            }
            EXPECT_LE(beams.price_ns, before);
            before = beams.price_ns;
        }
        EXPECT_LT(before, std::numeric_limits<double>::infinity());
    }
}

TEST(BeamProposal, keeps_to_the_price_asked_for) {
    const BeamProposal proposal = random_proposal(7);
    const ProposedBeams first = proposal.cheapest(0.02);
    const ProposedBeams cheaper = proposal.cheapest(0.02, 0.5 * first.price_ns);
    EXPECT_GT(cheaper.price_ns, 0);
    EXPECT_LE(cheaper.price_ns, 0.5 * first.price_ns);
    EXPECT_GT(cheaper.error, first.error);
    EXPECT_EQ(proposal.cheapest(0.2, 1).price_ns, 0) << "there is none as cheap";
}

// Where nothing reaches what is allowed, little is not bought dearly.
TEST(BeamProposal, pays_for_no_more_than_it_gets) {
    BeamProposal proposal = random_proposal(3);
    proposal.sets = {{29, 0.14, 0, 0}};
    const ProposedBeams best = proposal.cheapest(0.01);
    EXPECT_GT(best.error, 0.14);
    EXPECT_LE(best.error, 1.25 * 0.16) << "the wavelengths' and what cannot be made less";
    for (const CutChoice& cut : proposal.cuts) {
        // No coarser cut with the same borders would have been as good.
        if (cut.weight > best.cut.weight && std::hypot(cut.error, 0.14) < best.error) {
            EXPECT_GT(std::hypot(cut.error, best.borders), best.cut.error);
        }
    }
}

// Pictures whose true errors are those guessed, but for one cause, which brings four times as much:
// what is proposed next is never as coarse as what failed, and near enough after few pictures.
TEST(BeamProposal, finds_out_what_is_to_blame) {
    int pictures = 0, cases = 0;
    for (unsigned seed = 0; seed < 30; ++seed) {
        for (const int to_blame : {0, 1, 2}) {
            SCOPED_TRACE(testing::Message() << seed << " " << to_blame);
            BeamProposal proposal = random_proposal(seed);
            const double room = 0.05;
            const auto truth = [&](const ProposedBeams& beams) {
                const double by_cause[] = {beams.cut.error, beams.wavelengths.error, beams.borders};
                double sum = std::pow(proposal.effects, 2);
                for (int c = 0; c < 3; ++c)
                    sum += std::pow((c == to_blame ? 4 : 1) * by_cause[c], 2);
                return std::sqrt(sum);
            };
            ProposedBeams beams = proposal.cheapest(room);
            const double finest[] = {proposal.cuts.back().error, proposal.sets.back().error, 0};
            // Where even the finest would not do, there is nothing to be found.
            if (beams.error > room || 4 * finest[to_blame] > 0.5 * room) continue;
            ++cases;
            std::vector<ProposedBeams> failed;
            for (; truth(beams) > 1.1 * room && failed.size() < 8; ++pictures) {
                failed.push_back(beams);
                proposal.learn(beams, truth(beams));
                beams = proposal.cheapest(room);
                ASSERT_GT(beams.price_ns, 0);
                for (const ProposedBeams& before : failed)
                    EXPECT_FALSE(beams.no_finer_than(before));
            }
            EXPECT_LT(failed.size(), 6u);
        }
    }
    EXPECT_GT(cases, 40);
    EXPECT_LT(pictures, 2 * cases) << "in the mean";
}

// What pixels have shown is taken as it is; others are off in the proportion that was guessed, but
// coarser ones by no less than was guessed.
TEST(BeamProposal, knows_what_pixels_have_shown) {
    for (unsigned seed = 0; seed < 20; ++seed) {
        SCOPED_TRACE(seed);
        const BeamProposal guessed = random_proposal(seed);
        BeamProposal proposal = guessed;
        const std::size_t which = 1 + seed % 4;
        const double factor = seed % 2 == 0 ? 7 : 0.2;
        const double off_by_cut = factor * guessed.cuts[which].error,
                     off_by_colours = factor * guessed.sets[which].error;
        proposal.know_cut(guessed.cuts[which].weight, off_by_cut);
        proposal.know_wavelengths(guessed.sets[which].count, off_by_colours);
        EXPECT_TRUE(proposal.knows_cut(guessed.cuts[which].weight));
        EXPECT_FALSE(proposal.knows_cut(guessed.cuts[0].weight));
        EXPECT_EQ(proposal.cuts[which].error, off_by_cut);
        EXPECT_EQ(proposal.sets[which].error, off_by_colours);
        const auto of_others = [&](std::size_t i, double guess) {
            return (i < which ? std::max(factor, 1.0) : factor) * guess;
        };
        for (std::size_t i = 0; i < proposal.cuts.size(); ++i)
            EXPECT_NEAR(proposal.cuts[i].error, of_others(i, guessed.cuts[i].error), 1e-15);
        for (std::size_t i = 0; i < proposal.sets.size(); ++i)
            EXPECT_NEAR(proposal.sets[i].error, of_others(i, guessed.sets[i].error), 1e-15);
        // A finer one that is found to be off by as much: what is between is not less, and coarser
        // ones stay as they are known.
        const BeamProposal before = proposal;
        proposal.know_cut(guessed.cuts[which + 2].weight, off_by_cut);
        EXPECT_EQ(proposal.cuts[which + 2].error, off_by_cut);
        for (std::size_t i = 0; i <= which; ++i)
            EXPECT_EQ(proposal.cuts[i].error, before.cuts[i].error);
        EXPECT_EQ(proposal.cuts[which + 1].error,
                  std::max(off_by_cut, before.cuts[which + 1].error));
        for (std::size_t i = which + 3; i < proposal.cuts.size(); ++i)
            EXPECT_LE(proposal.cuts[i].error, off_by_cut);
    }
}

// As in `finds_out_what_is_to_blame`, but pixels have shown what the first picture's cut and
// wavelengths brought: where one of them was to blame, the next picture is near enough.
TEST(BeamProposal, needs_no_second_guess_of_what_is_known) {
    int cases = 0;
    for (unsigned seed = 0; seed < 60; ++seed) {
        for (const bool cut_is_to_blame : {true, false}) {
            SCOPED_TRACE(testing::Message() << seed << " " << cut_is_to_blame);
            BeamProposal proposal = random_proposal(seed);
            const double room = 0.05, by_cut = cut_is_to_blame ? 4 : 1,
                         by_colours = cut_is_to_blame ? 1 : 4;
            const auto truth = [&](double cut, double colours, double borders) {
                return std::sqrt(std::pow(by_cut * cut, 2) + std::pow(by_colours * colours, 2) +
                                 std::pow(borders, 2) + std::pow(proposal.effects, 2));
            };
            const BeamProposal guessed = proposal;
            const auto error_of = [&](const ProposedBeams& beams) {
                double cut = 0, colours = 0;
                for (const CutChoice& choice : guessed.cuts)
                    if (choice.weight == beams.cut.weight) cut = choice.error;
                for (const WavelengthChoice& choice : guessed.sets)
                    if (choice.count == beams.wavelengths.count) colours = choice.error;
                return truth(cut, colours, beams.borders);
            };
            const ProposedBeams first = proposal.cheapest(room);
            if (error_of(first) <= 1.1 * room ||
                truth(guessed.cuts.back().error, guessed.sets.back().error, 0) > 0.5 * room)
                continue;
            ++cases;
            BeamProposal of_glance = proposal;
            for (BeamProposal* one : {&proposal, &of_glance}) {
                one->know_cut(first.cut.weight, by_cut * first.cut.error);
                one->know_wavelengths(first.wavelengths.count,
                                      by_colours * first.wavelengths.error);
                one->learn(first, error_of(first));
            }
            const ProposedBeams second = proposal.cheapest(room);
            EXPECT_LE(error_of(second), 1.25 * room);
            // And so for a proposal of the same scene that is told.
            BeamProposal told = guessed;
            told.learn_from(of_glance);
            EXPECT_EQ(told.cheapest(room).price_ns, second.price_ns);
        }
    }
    EXPECT_GT(cases, 20);
}

// A crystal all but without a difference of indices, its picture drawn finer than anything can
// tell: no cause is expected of any error, and none found is blamed on one.
TEST(BeamProposal, stays_finite_where_nothing_is_expected) {
    BeamProposal proposal;
    proposal.cuts.push_back({0.01, 0, 0, 0});
    proposal.sets.push_back({1, 0, 0, 0});
    proposal.pixels = 1000;
    proposal.events_per_ray = 0;
    const ProposedBeams drawn = proposal.cheapest(0.01);
    for (const double error : {0.0, 1e-15, 0.02}) {
        proposal.learn(drawn, error);
        const ProposedBeams next = proposal.cheapest(0.01);
        EXPECT_TRUE(std::isfinite(next.error)) << error;
        EXPECT_TRUE(std::isfinite(next.price_ns)) << error;
    }
}

TEST(BeamProposal, learns_from_another) {
    BeamProposal glance = random_proposal(9), plan = random_proposal(9);
    const ProposedBeams drawn = glance.cheapest(0.08);
    glance.learn(drawn, 4 * drawn.error);
    plan.learn_from(glance);
    EXPECT_EQ(plan.cheapest(0.08).price_ns, glance.cheapest(0.08).price_ns);
    EXPECT_GT(plan.cheapest(0.08).price_ns, drawn.price_ns);
    // Where it does not offer the same choice, there is nothing to learn.
    BeamProposal other = random_proposal(9);
    other.cuts = {{0.02, 0.01, 0, 0}};
    const double price = other.cheapest(0.08).price_ns;
    other.learn_from(glance);
    EXPECT_EQ(other.cheapest(0.08).price_ns, price);
}

// The two waves of a crystal: only finer cuts are dear.
TEST(BeamProposal, of_parted_waves_cost_by_their_cuts) {
    BeamProposal proposal = random_proposal(2);
    proposal.parted = true;
    proposal.previews = false;
    const ProposedBeams coarse = proposal.cheapest(0.2), fine = proposal.cheapest(0.03);
    EXPECT_FALSE(coarse.preview);
    EXPECT_LT(fine.cut.weight, coarse.cut.weight);
    EXPECT_GT(fine.price_ns, 2 * coarse.price_ns);
}

// A scene that names wavelengths, engine and cut leaves nothing to choose.
TEST(BeamProposal, of_a_single_choice_is_that) {
    BeamProposal proposal;
    proposal.cuts = {{0.01, 0, 0, 0}};
    proposal.sets = {{}};
    proposal.pixels = 1000;
    proposal.borders_are_open = false;
    RenderSettings settings;
    settings.wavelengths_nm = {500, 600};
    proposal.cheapest(0.1).apply_to(settings);
    EXPECT_EQ(settings.engine, "preview");
    EXPECT_EQ(settings.cut_weight, 0.01);
    EXPECT_EQ(settings.wavelengths_nm, (std::vector<double>{500, 600}));
}

}  // namespace
}  // namespace culet
