#include "studio/gate.h"

#include <fmt/format.h>

#include <algorithm>
#include <random>

namespace culet {

namespace {

// Takes as long for any wrong text as for the right one.
bool same(const std::string& given, const std::string& secret) {
    if (given.size() != secret.size()) return false;
    unsigned char different = 0;
    for (std::size_t i = 0; i < secret.size(); ++i) {
        different |= static_cast<unsigned char>(given[i] ^ secret[i]);
    }
    return different == 0;
}

// The value of one cookie in a header `a=1; b=2`.
std::string cookie_in(const std::string& header, const std::string& name) {
    for (std::size_t at = 0; at < header.size();) {
        const std::size_t begin = header.find_first_not_of(' ', at);
        const std::size_t end = std::min(header.find(';', at), header.size());
        if (begin < end && header.compare(begin, name.size() + 1, name + "=") == 0) {
            return header.substr(begin + name.size() + 1, end - begin - name.size() - 1);
        }
        at = end + 1;
    }
    return {};
}

}  // namespace

std::string random_token() {
    std::random_device system;
    std::string token;
    for (int i = 0; i < 4; ++i) token += fmt::format("{:08x}", system());
    return token;
}

Gate::Gate(int port) : port_(std::to_string(port)) {}

std::string Gate::address() const {
    return fmt::format("http://127.0.0.1:{}/?token={}", port_, token_);
}

std::string Gate::cookie() const {
    return fmt::format("culet_{}={}; Path=/; HttpOnly; SameSite=Strict", port_, secret_);
}

bool Gate::is_own(const std::string& host) const {
    return host == "127.0.0.1:" + port_ || host == "localhost:" + port_;
}

Gate::Verdict Gate::verdict(const Knock& knock) const {
    // A foreign name that was made to lead here (DNS rebinding) stands in Host; another site's
    // page names itself in Origin.
    if (knock.hosts.size() != 1 || !is_own(knock.hosts.front())) return Verdict::refuse;
    for (const std::string& origin : knock.origins) {
        constexpr std::string_view k_scheme = "http://";
        if (!origin.starts_with(k_scheme) || !is_own(origin.substr(k_scheme.size())))
            return Verdict::refuse;
    }
    for (const std::string& cookies : knock.cookies) {
        if (same(cookie_in(cookies, "culet_" + port_), secret_) && !knock.token)
            return Verdict::pass;
    }
    if (knock.path == "/" && knock.token && same(*knock.token, token_)) return Verdict::give_cookie;
    return Verdict::refuse;
}

}  // namespace culet
