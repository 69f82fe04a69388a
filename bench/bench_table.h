#pragma once
// Tables for people on stdout, and the same as JSON.

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace culet {

class BenchTables {
public:
    BenchTables();
    ~BenchTables();

    /// Begins a section; `columns` are all names except the first.
    void section(const std::string& name, const std::string& remark,
                 const std::vector<std::string>& columns);
    /// Numbers as text, empty where there is none.
    void line(const std::string& what, const std::vector<std::string>& values);
    /// A conclusion from the lines before.
    void remark(const std::string& text);
    /// Returns one object: `head`, and `sections`, each with `name`, `about`, `lines` and
    /// `remarks`.
    std::string json(const std::vector<std::pair<std::string, std::string>>& head) const;

private:
    struct Content;
    std::unique_ptr<Content> content_;
};

}  // namespace culet
