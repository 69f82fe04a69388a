#pragma once
// The room's main header: a stone, its readings and its fit in a browser's window.

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

namespace culet {

struct StudioOptions {
    /// A folder, a stone file, a mesh or a design (new_project.h).
    std::filesystem::path input = ".";
    int port = 0;  ///< 0: a free one
    std::string version;
};

/// Listens on 127.0.0.1 from its making on. Throws InputError when the input cannot be opened, or
/// the port is taken.
class Studio {
public:
    explicit Studio(const StudioOptions& options);
    ~Studio();
    Studio(const Studio&) = delete;
    Studio& operator=(const Studio&) = delete;

    /// `http://127.0.0.1:PORT/?token=...`: whoever has it may use the studio.
    const std::string& address() const;
    int port() const;
    /// A page that leads there: other users see a browser's command line, but not into a private
    /// folder.
    std::string opening_page() const;

    /// Answers until `wanted`, which is asked ten times a second, returns false.
    void run(const std::function<bool()>& wanted);

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace culet
