#pragma once
// Tables of a quantity by wavelength: two columns, as instruments, databases and people write them.

#include <filesystem>
#include <string>
#include <vector>

#include "stone/material/spectrum.h"

namespace culet {

/// Reads lines of wavelength and value, split by commas, semicolons, tabs or blanks, with one
/// header line or none, from short to long wavelengths or the other way. `quantity` (refractive
/// index) is for messages.
///
/// The unit of the wavelengths is the header's (nm, um, Angstrom) or else the one of nm, um,
/// Angstrom, in this order, in which the table covers a part of the visible (380 to 780 nm). A
/// value per cm (so says the header) becomes one per mm. What was told by the range, or converted,
/// is said in `notes`. Throws InputError with the line of what is no number, of a wavelength given
/// twice, and of a second table below the first; and where no unit, or more than one, can be meant.
Spectrum read_wavelength_table(const std::filesystem::path& file, const char* quantity,
                               std::vector<std::string>& notes);

}  // namespace culet
