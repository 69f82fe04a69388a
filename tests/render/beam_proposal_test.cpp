#include "render/plan/beam_proposal.h"

#include <gtest/gtest.h>

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

bool finer(const ProposedBeams& a, const ProposedBeams& b) {
    const bool borders =
        (b.preview && !a.preview) || (a.preview == b.preview && a.tolerance < b.tolerance);
    return a.cut.weight < b.cut.weight && a.wavelengths.count > b.wavelengths.count && borders;
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
                // None does: it is the one that is likely off least.
                EXPECT_EQ(beams.error, proposal.cheapest(0).error);
                continue;
            }
            EXPECT_LE(beams.price_ns, before);
            before = beams.price_ns;
        }
        EXPECT_LT(before, std::numeric_limits<double>::infinity());
    }
}

TEST(BeamProposal, keeps_between_the_prices_asked_for) {
    const BeamProposal proposal = random_proposal(7);
    const ProposedBeams first = proposal.cheapest(0.2);
    const ProposedBeams next = proposal.cheapest(1e-6, first.price_ns, 4 * first.price_ns);
    EXPECT_GT(next.price_ns, first.price_ns);
    EXPECT_LE(next.price_ns, 4 * first.price_ns);
    EXPECT_LT(next.error, first.error);
    EXPECT_EQ(proposal.cheapest(0.2, 1e300).price_ns, 0) << "there is none as dear";
}

// A picture that was off four times as much as was guessed calls for finer ones.
TEST(BeamProposal, learns_from_what_a_picture_was_off_by) {
    for (unsigned seed = 0; seed < 50; ++seed) {
        SCOPED_TRACE(seed);
        BeamProposal proposal = random_proposal(seed);
        const ProposedBeams drawn = proposal.cheapest(0.08);
        if (drawn.error > 0.08) continue;
        proposal.learn(drawn, drawn.error);
        EXPECT_NEAR(proposal.cheapest(0.08).price_ns, drawn.price_ns, 1e-6 * drawn.price_ns)
            << "as was guessed: nothing changes";
        proposal.learn(drawn, 4 * drawn.error);
        EXPECT_GT(proposal.cheapest(0.08).price_ns, drawn.price_ns);
    }
}

TEST(BeamProposal, makes_all_finer_where_nobody_knows_what_is_to_blame) {
    for (unsigned seed = 0; seed < 50; ++seed) {
        SCOPED_TRACE(seed);
        const BeamProposal proposal = random_proposal(seed);
        const ProposedBeams drawn = proposal.cheapest(0.12);
        EXPECT_TRUE(finer(proposal.finer_in_all(drawn), drawn));
    }
    // The finest there are cannot be made finer.
    const BeamProposal proposal = random_proposal(1);
    ProposedBeams finest = proposal.cheapest(0.12);
    for (int k = 0; k < 20 && finest.price_ns > 0; ++k) finest = proposal.finer_in_all(finest);
    EXPECT_EQ(finest.price_ns, 0);
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
