#pragma once
// Who may speak to the studio: whoever was given its address, in a page of its own.

#include <optional>
#include <string>
#include <vector>

namespace culet {

/// 128 random bits of the system, as 32 hexadecimal digits.
std::string random_token();

/// What of a request decides whether it is answered. Every header once, or as often as it came.
struct Knock {
    std::string path;
    std::vector<std::string> hosts, origins, cookies;
    std::optional<std::string> token;  ///< of the address
};

class Gate {
public:
    /// The port that the server listens on.
    explicit Gate(int port);

    enum class Verdict {
        pass,
        give_cookie,  ///< the address with its token: answer with `cookie` and without the token
        refuse
    };
    Verdict verdict(const Knock& knock) const;

    /// The address that opens the studio, with its token.
    std::string address() const;
    /// The value of Set-Cookie. It is named by the port, which cookies do not distinguish.
    std::string cookie() const;

private:
    bool is_own(const std::string& host) const;

    std::string port_, token_ = random_token(), secret_ = random_token();
};

}  // namespace culet
