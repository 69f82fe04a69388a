#pragma once
// Reads two-column tables of a quantity by wavelength, as instruments, databases and people write
// them.

#include <filesystem>
#include <string>
#include <vector>

#include "stone/material/spectrum.h"

namespace culet {

/// Reads wavelength and value, separated by commas, semicolons, tabs or blanks, with at most one
/// header line, in either order of wavelengths. `quantity` (refractive index) is for messages.
///
/// The wavelengths' unit is the header's (nm, um, Angstrom), or else the first of nm, um, Angstrom
/// in which the table covers a part of the visible (380 to 780 nm). Values per cm (by the header)
/// become values per mm. `notes` report guesses and conversions. Throws InputError with the line of
/// a non-number, a repeated wavelength or a second table; and where no unit or several fit.
Spectrum read_wavelength_table(const std::filesystem::path& file, const char* quantity,
                               std::vector<std::string>& notes);

}  // namespace culet
