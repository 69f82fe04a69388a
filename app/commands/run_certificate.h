#pragma once
// The certificate of a job.

#include <filesystem>

#include "page/certificate.h"
#include "stone/text/toml_file.h"

namespace culet {

struct CertificateJob {
    Certificate certificate;
    bool pdf = true;  ///< print it if there is a Chromium
};

/// What the job's [certificate] states. Throws InputError.
CertificateJob read_certificate(const TomlTable& table);

/// Writes certificate.html and, if a Chromium prints it, certificate.pdf. A browser that fails is a
/// note.
void write_certificate(CertificateJob job, const std::filesystem::path& folder, bool quiet);

}  // namespace culet
