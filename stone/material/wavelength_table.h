#pragma once
// Reads tables of a quantity by wavelength: two columns, as instruments, databases and people write
// them.

#include <filesystem>
#include <string>
#include <vector>

#include "stone/material/spectrum.h"

namespace culet {

/// Reads lines of wavelength and value, separated by commas, semicolons, tabs or blanks, with at
/// most one header line, in ascending or descending order. `quantity` (refractive index) is for
/// messages.
///
/// The wavelengths' unit is the header's (nm, um, Angstrom). Without one it is the first of nm, um,
/// Angstrom in which the table covers a part of the visible (380 to 780 nm). A value per cm (by the
/// header) becomes one per mm. `notes` report a guessed unit and conversions. Throws InputError
/// with the line of what is not a number, of a repeated wavelength, and of a second table; and
/// where no unit or several fit.
Spectrum read_wavelength_table(const std::filesystem::path& file, const char* quantity,
                               std::vector<std::string>& notes);

}  // namespace culet
