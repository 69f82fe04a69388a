#include "studio/view_engine.h"

#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>

#include "stone/text/errors.h"
#include "stone/text/path_fence.h"
#include "studio/apart.h"
#include "viewer/engine/viewer_engine.h"

namespace culet {

namespace {

using Json = nlohmann::ordered_json;

// Both ends send a size and so many bytes.
bool send_all(int socket, const void* bytes, std::size_t size) {
    for (const char* at = static_cast<const char*>(bytes); size > 0;) {
        const ssize_t sent = send(socket, at, size, MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR) continue;
        if (sent <= 0) return false;
        at += sent;
        size -= static_cast<std::size_t>(sent);
    }
    return true;
}

bool receive_all(int socket, void* bytes, std::size_t size) {
    for (char* at = static_cast<char*>(bytes); size > 0;) {
        const ssize_t got = recv(socket, at, size, 0);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return false;
        at += got;
        size -= static_cast<std::size_t>(got);
    }
    return true;
}

bool send_text(int socket, const std::string& text) {
    const std::uint64_t size = text.size();
    return send_all(socket, &size, sizeof size) && send_all(socket, text.data(), text.size());
}

std::optional<std::string> received_text(int socket) {
    std::uint64_t size = 0;
    if (!receive_all(socket, &size, sizeof size)) return std::nullopt;
    std::string text(size, '\0');
    if (!receive_all(socket, text.data(), size)) return std::nullopt;
    return text;
}

template <class Number>
std::string bytes_of(const std::vector<Number>& numbers) {
    return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)};
}

std::string answered(ViewerEngine& engine, const std::string& request) {
    const std::size_t line = std::min(request.find('\n'), request.size());
    const Json head = Json::parse(request.substr(0, line));
    const auto call = head.at("call").get<std::string>();
    const std::string attached = line < request.size() ? request.substr(line + 1) : "";
    const std::string answer = engine.answer(call, head.at("arguments").dump(), attached);
    const std::string bytes = call == "draw"       ? bytes_of(engine.pixels())
                              : call == "radiance" ? bytes_of(engine.radiance())
                              : call == "gpu"      ? bytes_of(engine.texels())
                                                   : std::string();
    return answer + "\n" + bytes;
}

// The process of the engine: answers with `d` and the answer, or `f` and what is wrong.
[[noreturn]] void serve(int socket, const std::string& version,
                        const std::filesystem::path& folder) {
    leave_the_studio(socket);
    const PathFence fence(folder);
    ViewerEngine engine(version);
    while (const auto request = received_text(socket)) {
        std::string text;
        try {
            text = "d" + answered(engine, *request);
        } catch (const InputError& error) {
            text = fmt::format("f{}", error.what());
        } catch (const Json::exception&) {
            text = "fthe call is not as the page makes it";
        } catch (const std::exception& error) {
            text = fmt::format("f{} (an error in culet itself)", error.what());
        }
        if (!send_text(socket, text)) break;
    }
    _exit(0);
}

}  // namespace

ViewEngine::ViewEngine(std::string version, std::filesystem::path folder, std::mutex& quiet)
    : version_(std::move(version)), folder_(std::move(folder)), quiet_(quiet) {}

ViewEngine::~ViewEngine() {
    end();
}

void ViewEngine::start() {
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
        throw InputError("no socket can be opened for the engine");
    std::unique_lock lock(quiet_);
    process_ = fork();
    if (process_ == 0) serve(ends[1], version_, folder_);
    lock.unlock();
    close(ends[1]);
    socket_ = ends[0];
    if (process_ > 0) return;
    end();
    throw InputError("no process can be started for the engine");
}

void ViewEngine::end() {
    if (socket_ >= 0) close(socket_);
    socket_ = -1;
    if (process_ > 0) {
        kill(process_, SIGKILL);
        while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
        }
    }
    process_ = 0;
}

ViewEngine::Reply ViewEngine::answer(const std::string& request) {
    const std::lock_guard lock(mutex_);
    if (socket_ < 0) start();
    std::optional<std::string> text;
    if (send_text(socket_, request)) text = received_text(socket_);
    if (!text || text->empty()) {
        end();
        return {Reply::How::died, "the engine crashed: an error in culet itself, please report it"};
    }
    return {text->front() == 'd' ? Reply::How::done : Reply::How::refused, text->substr(1)};
}

}  // namespace culet
