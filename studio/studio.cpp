// The network side: the only file that knows the HTTP library.

#include "studio/studio.h"

#include <fmt/format.h>
#include <httplib.h>

#include <chrono>
#include <thread>

#include "stone/text/errors.h"
#include "studio/answers.h"
#include "studio/gate.h"
#include "studio/templates.h"

namespace culet {

namespace embedded {
extern const char* const page_css;
extern const char* const studio_css;
extern const char* const studio_js;
}  // namespace embedded

namespace {

using namespace std::chrono_literals;
using httplib::Request;
using httplib::Response;
using httplib::Server;

// Each listening window keeps one of them.
constexpr std::size_t k_threads = k_most_windows + 8;
constexpr int k_found = 200, k_see_other = 303, k_refused = 403, k_too_large = 413, k_busy = 503;

std::vector<std::string> all_of(const Request& request, const char* header) {
    std::vector<std::string> values;
    for (std::size_t i = 0; i < request.get_header_value_count(header); ++i)
        values.push_back(request.get_header_value(header, i));
    return values;
}

Knock knock_of(const Request& request) {
    Knock knock{request.path, all_of(request, "Host"), all_of(request, "Origin"),
                all_of(request, "Cookie"), std::nullopt};
    if (request.has_param("token")) knock.token = request.get_param_value("token");
    return knock;
}

// A page that leads to an address at once.
std::string page_to(const std::string& address) {
    return filled(templates::opening, {{"address", address}});
}

Call call_of(const Request& request) {
    return {request.method == "POST", request.path, request.body, request.get_param_value("window"),
            request.get_param_value("name")};
}

// It is a page of its own, whose scripts stand inside. In its sandbox it has no origin, and so can
// ask nothing of the studio.
void answer_in_sandbox(const Answer& answer, Response& response) {
    response.status = answer.status;
    response.set_content(answer.body, answer.type);
    response.headers.erase("Content-Security-Policy");
    response.set_header("Content-Security-Policy",
                        "sandbox allow-scripts allow-downloads allow-modals; default-src 'none'; "
                        "img-src data: blob:; media-src blob:; style-src 'unsafe-inline'; "
                        "script-src 'unsafe-inline' 'wasm-unsafe-eval' blob:; worker-src blob:; "
                        "frame-ancestors 'self'");
}

}  // namespace

struct Studio::Parts {
    explicit Parts(const StudioOptions& options)
        : answers(options.input, options.version),
          port(bound(options.port)),
          gate(port),
          address(gate.address()),
          page(filled(templates::studio, {{"version", options.version}})) {
        prepare();
        add_routes();
    }

    int bound(int wanted) {
        // The library's own would let a second program listen on the same port.
        server.set_socket_options([](socket_t socket) {
            const int yes = 1;
            setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
        });
        if (wanted == 0) return server.bind_to_any_port("127.0.0.1");
        return server.bind_to_port("127.0.0.1", wanted) ? wanted : -1;
    }

    void prepare();
    void add_routes();
    Server::HandlerResponse let_in(const Request& request, Response& response) const;
    void listen_to_events(const Request& request, Response& response);

    Server server;
    Answers answers;
    int port;
    Gate gate;
    std::string address, page;
};

void Studio::Parts::prepare() {
    if (port < 0) throw InputError("--port: this port is taken: choose another, or none");
    server.new_task_queue = [] { return new httplib::ThreadPool(k_threads); };
    // What a refused request leaves unread on its connection is never taken for a next request.
    server.set_keep_alive_max_count(1);
    server.set_tcp_nodelay(true);
    server.set_payload_max_length(k_largest_upload);
    server.set_default_headers(
        {{"Content-Security-Policy",
          "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; "
          "frame-src 'self'; connect-src 'self'; form-action 'none'; base-uri 'none'; "
          "frame-ancestors 'none'"},
         {"X-Content-Type-Options", "nosniff"},
         {"Referrer-Policy", "no-referrer"},
         {"Cross-Origin-Opener-Policy", "same-origin"},
         {"Cross-Origin-Resource-Policy", "same-origin"},
         {"Cache-Control", "no-store"}});
    server.set_pre_routing_handler(
        [this](const Request& request, Response& response) { return let_in(request, response); });
    server.set_exception_handler([](const Request&, Response& response, std::exception_ptr) {
        response.status = 500;
        response.set_content("an error in culet itself", "text/plain");
    });
}

// Before the body of a request is read.
Server::HandlerResponse Studio::Parts::let_in(const Request& request, Response& response) const {
    const auto refused = [&](int status, const char* why) {
        response.status = status;
        response.set_content(why, "text/plain");
        return Server::HandlerResponse::Handled;
    };
    switch (gate.verdict(knock_of(request))) {
        case Gate::Verdict::refuse:
            return refused(k_refused, "Open the address that culet studio printed.\n");
        case Gate::Verdict::give_cookie:
            response.set_header("Set-Cookie", gate.cookie());
            response.set_redirect("/", k_see_other);
            // A strict cookie does not follow a redirect of a link on another page, but the page's
            // own step does.
            if (request.get_header_value("Sec-Fetch-Site") == "cross-site") {
                response.headers.erase("Location");
                response.status = k_found;
                response.set_content(page_to("/"), "text/html; charset=utf-8");
            }
            return Server::HandlerResponse::Handled;
        case Gate::Verdict::pass:
            // The way to the browser is shorter than compressing for it.
            const_cast<Request&>(request).headers.erase("Accept-Encoding");
            break;
    }
    const auto length = request.get_header_value<std::uint64_t>("Content-Length");
    const bool uploads = request.path.ends_with("/upload") || request.path == "/api/engine";
    if (length > (uploads ? k_largest_upload : k_largest_call))
        return refused(k_too_large, "This is too large.\n");
    if (request.method == "POST" &&
        (!request.has_header("Content-Length") || request.is_multipart_form_data()))
        return refused(k_too_large, "Its size must be told before.\n");
    return Server::HandlerResponse::Unhandled;
}

void Studio::Parts::add_routes() {
    const auto file = [this](const char* path, const std::string& content, const char* type) {
        server.Get(path, [content, type](const Request&, Response& response) {
            response.set_content(content, type);
        });
    };
    file("/", page, "text/html; charset=utf-8");
    file("/studio.css",  // In the look of all pages.
         std::string(embedded::page_css) + embedded::studio_css, "text/css; charset=utf-8");
    file("/studio.js", embedded::studio_js, "text/javascript; charset=utf-8");
    server.Get("/api/events", [this](const Request& request, Response& response) {
        listen_to_events(request, response);
    });
    server.Get("/view", [this](const Request&, Response& response) {
        answer_in_sandbox(answers.view(), response);
    });
    server.Get("/grade", [this](const Request&, Response& response) {
        answer_in_sandbox(answers.grade_page(), response);
    });
    const auto answered = [this](const Request& request, Response& response) {
        const Answer answer = answers.to(call_of(request));
        response.status = answer.status;
        response.set_content(answer.body, answer.type);
        if (!answer.file.empty())
            response.set_header("Content-Disposition",
                                fmt::format("attachment; filename=\"{}\"", answer.file));
    };
    server.Get("/api/.*", answered);
    server.Post("/api/engine", [this](const Request& request, Response& response) {
        const Answer answer = answers.engine(call_of(request));
        response.status = answer.status;
        response.set_content(answer.body, answer.type);
    });
    server.Post("/api/.*", answered);
}

void Studio::Parts::listen_to_events(const Request& request, Response& response) {
    const std::string id = request.get_param_value("window");
    const auto window = answers.events().open(id);
    if (window == nullptr) {
        response.status = k_busy;
        response.set_content("Too many windows are open.\n", "text/plain");
        return;
    }
    answers.window_opened(id);
    const auto tell = [this, window](std::size_t, httplib::DataSink& sink) {
        // A comment now and then finds out that a window was closed.
        constexpr auto k_beat = 500ms;
        const auto news = answers.events().next(*window, k_beat);
        if (answers.events().stopped()) {
            sink.done();
            return true;
        }
        const std::string line =
            news ? fmt::format("event: {}\ndata: {}\n\n", news->first, news->second) : ":\n\n";
        return sink.is_writable() && sink.write(line.data(), line.size());
    };
    response.set_chunked_content_provider("text/event-stream", tell, [this, window, id](bool) {
        answers.events().close(window);
        answers.window_closed(id);
    });
}

Studio::Studio(const StudioOptions& options) : parts_(std::make_unique<Parts>(options)) {}

Studio::~Studio() = default;

const std::string& Studio::address() const {
    return parts_->address;
}

std::string Studio::opening_page() const {
    return page_to(parts_->address);
}

int Studio::port() const {
    return parts_->port;
}

void Studio::run(const std::function<bool()>& wanted) {
    std::thread listening([this] { parts_->server.listen_after_bind(); });
    constexpr int k_between_looks = 10;
    for (int step = 0; wanted(); ++step) {
        std::this_thread::sleep_for(100ms);
        if (step % k_between_looks == 0) parts_->answers.look_outside();
    }
    parts_->answers.events().stop();
    // A server that does not listen yet does not hear the stop.
    while (!parts_->server.is_running()) std::this_thread::sleep_for(1ms);
    parts_->server.stop();
    listening.join();
}

}  // namespace culet
