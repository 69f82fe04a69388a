// The [fit] table of a stone file.

#include <fmt/format.h>

#include <string>

#include "fit/model/options.h"
#include "stone/mesh/mesh_io.h"
#include "stone/text/toml_file.h"

namespace culet {

const char* name_of(MeetTreatment treatment) {
    switch (treatment) {
        case MeetTreatment::exact:
            return "exact";
        case MeetTreatment::soft:
            return "soft";
        case MeetTreatment::released:
            return "released";
    }
    return "exact";
}

const char* name_of(Loss loss) {
    switch (loss) {
        case Loss::none:
            return "none";
        case Loss::huber:
            return "huber";
        case Loss::cauchy:
            return "cauchy";
    }
    return "none";
}

const char* name_of(Prior::Source source) {
    switch (source) {
        case Prior::Source::none:
            return "none";
        case Prior::Source::catalogue:
            return "catalogue";
        case Prior::Source::mesh:
            return "mesh";
    }
    return "none";
}

namespace {

std::optional<std::filesystem::path> mesh_of(const TomlTable& file) {
    const auto stone = file.table("stone");
    return stone ? stone->path("mesh") : std::nullopt;
}

Prior::Source source_of(const TomlTable& file) {
    const auto mesh = mesh_of(file);
    return mesh && design_of(*mesh) ? Prior::Source::catalogue : Prior::Source::mesh;
}

Prior read_prior(const TomlTable& table, Prior prior) {
    if (const auto named = table.text("prior")) {
        prior.always = true;
        if (*named == "catalogue") {
            prior.source = Prior::Source::catalogue;
        } else if (*named == "mesh") {
            prior.source = Prior::Source::mesh;
        } else if (*named == "none") {
            prior.source = Prior::Source::none;
        } else {
            table.fail("prior", "`prior` of [fit] must be \"catalogue\", \"mesh\" or \"none\"");
        }
    }
    const auto positive = [&](const char* key, double most) {
        const auto value = table.number(key);
        if (value && !(*value > 0 && *value <= most)) {
            table.fail(
                key, fmt::format("`{}` of [fit] must be more than 0 and at most {:g}", key, most));
        }
        return value;
    };
    if (const auto degrees = positive("prior_inclination", 45)) {
        prior.inclination_sigma = radians(*degrees);
    }
    if (const auto degrees = positive("prior_azimuth", 45)) prior.azimuth_sigma = radians(*degrees);
    if (const auto percent = positive("prior_offset", 50)) prior.offset_sigma = *percent / 100;
    return prior;
}

}  // namespace

FitOptions read_fit_options(const std::filesystem::path& stone_file,
                            const std::vector<std::string>& overrides) {
    FitOptions options;
    const TomlTable file = read_toml(stone_file, overrides);
    options.prior.source = source_of(file);
    options.first_check = true;
    const auto mesh = mesh_of(file);
    options.mesh_has_size = !mesh || design_of(*mesh) != "GemCad";
    const auto table = file.table("fit");
    if (!table) return options;
    table->refuse_unknown({"meets", "meet_sigma", "iterations", "starts", "significance", "loss",
                           "find_symmetry", "allow_topology", "prior", "prior_inclination",
                           "prior_azimuth", "prior_offset"});
    options.prior = read_prior(*table, options.prior);
    if (const auto meets = table->text("meets")) {
        options.meets_named = true;
        if (*meets == "exact") {
            options.meets = MeetTreatment::exact;
        } else if (*meets == "soft") {
            options.meets = MeetTreatment::soft;
        } else if (*meets == "released") {
            options.meets = MeetTreatment::released;
        } else {
            table->fail("meets", "`meets` of [fit] must be \"exact\", \"soft\" or \"released\"");
        }
    }
    if (const auto loss = table->text("loss")) {
        if (*loss == "huber") {
            options.loss = Loss::huber;
        } else if (*loss == "cauchy") {
            options.loss = Loss::cauchy;
        } else if (*loss != "none") {
            table->fail("loss", "`loss` of [fit] must be \"none\", \"huber\" or \"cauchy\"");
        }
    }
    options.find_symmetry = table->boolean("find_symmetry").value_or(false);
    options.allow_topology = table->boolean("allow_topology").value_or(false);
    if (table->kind("meet_sigma") == TomlTable::Kind::number) {
        options.meet_sigma = table->number("meet_sigma");
    }
    const bool automatic =
        table->kind("meet_sigma") == TomlTable::Kind::text && table->text("meet_sigma") == "auto";
    if (table->has("meet_sigma") && !automatic && !(options.meet_sigma > 0.0)) {
        table->fail(
            "meet_sigma",
            "`meet_sigma` of [fit] must be a positive length in the stone's unit, or \"auto\"");
    }
    if (const auto iterations = table->integer("iterations")) {
        if (*iterations < 1 || *iterations > 1000000) {
            table->fail("iterations",
                        "`iterations` of [fit] must be a whole number of steps, 1 or more");
        }
        options.iterations = static_cast<int>(*iterations);
    }
    if (const auto starts = table->integer("starts")) {
        if (*starts < 1 || *starts > 1000) {
            table->fail("starts", "`starts` of [fit] must be a whole number from 1 to 1000");
        }
        options.starts = static_cast<int>(*starts);
    }
    if (const auto significance = table->number("significance")) {
        if (!(*significance > 0 && *significance < 0.5)) {
            table->fail("significance", "`significance` of [fit] must be between 0 and 0.5");
        }
        options.significance = *significance;
    }
    return options;
}

}  // namespace culet
