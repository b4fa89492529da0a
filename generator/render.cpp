// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/render.hpp"

#include <stdexcept>

#include "generator/template_text.hpp"

namespace algest::generator {

namespace {

/// Looks names up as mustache does, and stops where there is none.
class StrictContext : public kainjow::mustache::context<std::string> {
public:
    StrictContext(const Data* data, std::string path) : context(data), path_(std::move(path)) {}
    const Data* get(const std::string& name) const override {
        const Data* found = context::get(name);
        if (found == nullptr) throw std::logic_error("template " + path_ + " asks for '" + name + "', which is not given");
        return found;
    }

private:
    std::string path_;
};

}  // namespace

std::string render(const std::string& path, const Data& data) {
    const std::string_view text = template_text(path);
    if (text.data() == nullptr) throw std::logic_error("no template " + path);
    kainjow::mustache::mustache mustache{std::string(text)};
    mustache.set_custom_escape([](const std::string& s) { return s; });
    if (!mustache.is_valid()) throw std::logic_error("template " + path + ": " + mustache.error_message());
    StrictContext context(&data, path);
    std::string out = mustache.render(context);
    if (!mustache.is_valid()) throw std::logic_error("template " + path + ": " + mustache.error_message());
    return out;
}

Data listed(DataList list) {
    for (std::size_t k = 0; k < list.size(); ++k) {
        list[k].set("index", std::to_string(k));
        list[k].set("last", k + 1 == list.size());
    }
    return Data(list);
}

}  // namespace algest::generator
