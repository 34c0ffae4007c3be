#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include <beeline/model/arm.h>

namespace httplib {
class Server;
struct Request;
struct Response;
}  // namespace httplib

namespace beeline::command {

/// What the page asks the server for.
struct PageSession {
  Arm arm;
  std::string trajectory = {};  ///< the text of a .csv file that it plays; empty: none
  std::string section = {};     ///< the section that it begins with; empty: its first one
  std::string shaped_arm =
      {};                  ///< the arm with the shapes of its links, as JSON; empty: it has none
  std::string scene = {};  ///< the obstacles and the pairs that may touch, as JSON; empty: none
  std::optional<double> clearance = {};  ///< that the arm must keep, m; default: the page's

  /// The arm as JSON, with the shapes of its links.
  std::string arm_document() const;
};

/// Serves the page, and passes joint values from one program to all pages that are open.
///   GET  /api/session     {"version", "arm", "trajectory", "section", "scene", "clearance"}: texts
///                         of files, of which the arm's may have shapes, and the clearance in
///                         metres; null: none
///   GET  /api/events      server-sent events: joints {"q", "time", "sequence"}; the latest at once
///   POST /api/joints      {"q": [...], "time": t}, in radians, metres, seconds; time is optional
/// Every other GET is a file of the folder. A request whose Host or Origin is another site's is
/// refused (403), so that no page of the web reaches the server through the user's browser.
class PageServer {
 public:
  /// `folder`: the folder of the built page; `host`: the address to listen on.
  PageServer(PageSession session, const std::string& folder, std::string host);
  ~PageServer();

  /// Listens on the first free port from `port` on, of ten, and returns it. Throws Error where none
  /// is free.
  int bind(int port);
  /// Answers requests until stop() is called. After bind().
  void run();
  void stop();

 private:
  void make_server();
  void route();
  bool comes_from_here(const httplib::Request& request) const;
  void file(const httplib::Request& request, httplib::Response& response) const;
  void session(httplib::Response& response) const;
  /// Takes joint values as the latest ones. Throws Error for what is no configuration of the arm.
  void take_joints(const std::string& text);
  void events(httplib::Response& response);
  /// Waits for joint values after number `seen`, a second at most and while the page is open, and
  /// returns the text of the event: empty where there are none.
  std::string next_event(std::uint64_t& seen, const std::function<bool()>& is_open);

  PageSession session_;
  std::string folder_, host_;
  int port_ = 0;
  std::unique_ptr<httplib::Server> server_;  ///< from bind() on
  std::atomic<bool> stopped_ = false;
  std::atomic<int> pages_ = 0;  ///< open event streams
  std::mutex mutex_;            ///< of the members below
  std::condition_variable changed_;
  std::string latest_;          ///< joint values as JSON
  std::uint64_t sequence_ = 0;  ///< the number of the latest; 0: none yet
};

}  // namespace beeline::command
