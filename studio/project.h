#pragma once
// One stone in its folder: the stone file, its mesh and its readings, as the command line has them.

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "fit/findings/first_check.h"
#include "fit/model/options.h"
#include "fit/readings/readings_by_row.h"
#include "stone/stone_io.h"
#include "studio/edited_file.h"
#include "studio/readings_table.h"

namespace culet {

/// What a fit works on; it does not change while one runs.
struct LoadedStone {
    StoneFile file;
    FitOptions options;
    std::filesystem::path readings;
    std::vector<WrittenReading> written;  ///< rows that cannot be taken are skipped
};

class Project {
public:
    /// Reads all files. They may name files within the stone file's folder only. Throws InputError.
    explicit Project(const std::filesystem::path& stone_file);

    const std::filesystem::path& stone_file() const { return stone_file_; }
    const std::string& name() const { return loaded_->file.stone.name; }
    std::shared_ptr<const LoadedStone> loaded() const { return loaded_; }
    const ReadingsTable& table() const { return *table_; }
    EditedFile& readings() { return readings_; }
    const EditedFile& readings() const { return readings_; }
    /// Changes with every change of a file; `shape` with every other than of single cells.
    int revision() const { return revision_; }
    int shape() const { return shape_; }

    /// Found at once, before a fit: rows that cannot be taken, and readings far from similar ones.
    const std::vector<RowProblem>& problems() const { return problems_; }
    const std::vector<Doubt>& doubts() const { return doubts_; }
    const std::vector<Reading>& bound() const { return bound_; }
    /// The facets that each row of the table is about; rows without a value too.
    const std::vector<std::vector<std::string>>& facets_of_rows() const { return facets_; }

    /// Each saves the readings at once. Throw InputError, and then change nothing.
    void edit(const std::vector<ReadingsTable::Edit>& edits);
    void remove_row(std::size_t row);
    void undo();
    void redo();
    /// Settles a change of the readings by another program.
    void settle(bool take_other);

    /// True if the stone file or its mesh changed on the disk; they are then read again. Throws
    /// InputError when they cannot be.
    bool stone_changed();

private:
    void load();
    void check();
    std::vector<std::string> facets_of(const WrittenReading& written);
    std::pair<std::filesystem::file_time_type, std::filesystem::file_time_type> stamps() const;

    std::filesystem::path stone_file_;
    EditedFile readings_;
    std::shared_ptr<LoadedStone> loaded_;
    std::unique_ptr<ReadingsTable> table_;
    std::vector<RowProblem> problems_;
    std::vector<Reading> bound_;
    std::vector<Doubt> doubts_;
    std::vector<std::vector<std::string>> facets_;
    std::map<std::string, std::vector<std::string>> known_facets_;  // by kind and names
    std::pair<std::filesystem::file_time_type, std::filesystem::file_time_type> stamps_;
    int revision_ = 0, shape_ = 0;
};

}  // namespace culet
