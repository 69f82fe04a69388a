#pragma once
// A studio that runs, with one stone, and a browser's cookie.

#include <gtest/gtest.h>
#include <httplib.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "stone/cuts/cuts.h"
#include "stone/mesh/mesh_io.h"
#include "studio/studio.h"
#include "tests/folder_test.h"

namespace culet {

class StudioOverTheNetwork : public test::FolderTest {
protected:
    void SetUp() override {
        setenv("XDG_STATE_HOME", (folder_ / "state").c_str(), 1);
        write_design(make_cut("round-brilliant"), "round-brilliant", folder_ / "start.obj");
        write("readings.csv",
              "# by hand\nkind,of,value,sigma,note\ninclination,C1,33.8,0.1,\n"
              "inclination,C2,33.7,0.1,\ninclination,C3,33.9,0.1,\ninclination,C4,,0.1,\nwidth,0,6."
              "5,0.015,\n");
        write("stone.toml",
              "[stone]\nname = \"<b>bold</b>\"\nmesh = \"start.obj\"\nup = \"T\"\n"
              "readings = \"readings.csv\"\n" +
                  more_);
        start();
    }
    void TearDown() override { end(); }

    void start() {
        studio_ = std::make_unique<Studio>(StudioOptions{folder_.path(), 0, "0"});
        running_ = true;
        runs_ = std::thread([this] { studio_->run([this] { return running_.load(); }); });
        token_ = studio_->address().substr(studio_->address().find("token=") + 6);
        const auto answer = get("/?token=" + token_, {});
        ASSERT_TRUE(answer);
        const std::string cookie = answer->get_header_value("Set-Cookie");
        cookie_ = {{"Cookie", cookie.substr(0, cookie.find(';'))}};
    }
    void end() {
        if (!runs_.joinable()) return;
        running_ = false;
        runs_.join();
        studio_.reset();
    }

    httplib::Client client() const { return httplib::Client("127.0.0.1", studio_->port()); }
    httplib::Result get(const std::string& path, const httplib::Headers& headers) const {
        return client().Get(path.c_str(), headers);
    }
    httplib::Result post(const std::string& path, const std::string& body,
                         const httplib::Headers& headers) const {
        return client().Post(path.c_str(), headers, body, "application/json");
    }
    /// Announces two gigabytes, which must be refused before they are sent.
    void expect_too_large(const std::string& path) const {
        auto one = client();
        const auto answer = one.Post(
            path.c_str(), cookie_, std::size_t(2) << 30,
            [](std::size_t, std::size_t, httplib::DataSink& sink) {
                const std::string piece(1 << 16, 'x');
                return sink.write(piece.data(), piece.size());
            },
            "application/octet-stream");
        if (answer) {
            EXPECT_EQ(answer->status, 413);
        }
        EXPECT_EQ(get("/api/state", cookie_)->status, 200);
    }
    nlohmann::json table() const { return nlohmann::json::parse(get("/api/table", cookie_)->body); }
    int edit(int row, const std::string& column, const std::string& text) const {
        const nlohmann::json now = table();
        const nlohmann::json body{{"opened", now["opened"]},
                                  {"shape", now["shape"]},
                                  {"cells", {{{"row", row}, {"column", column}, {"text", text}}}}};
        return post("/api/cells?window=w", body.dump(), cookie_)->status;
    }
    /// The fit of the present readings, when it is done.
    nlohmann::json fit() const {
        for (int i = 0; i < 600; ++i) {
            const nlohmann::json now = nlohmann::json::parse(get("/api/fit", cookie_)->body);
            if (!now["runs"].get<bool>()) return now;
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        }
        return {};
    }

    /// What another window is told while something is done, up to the first event of this name.
    std::string heard(const std::string& event, const std::function<void()>& done) const {
        std::string heard;
        std::thread listens([&] {
            auto other = client();
            other.set_read_timeout(10);
            other.Get("/api/events?window=other", cookie_, [&](const char* data, std::size_t size) {
                heard.append(data, size);
                return heard.find("event: " + event) == std::string::npos;
            });
        });
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
        done();
        listens.join();
        return heard;
    }

    std::string more_;  ///< of the stone file
    std::unique_ptr<Studio> studio_;
    std::atomic<bool> running_{false};
    std::thread runs_;
    std::string token_;
    httplib::Headers cookie_;
};

}  // namespace culet
