#include "page_server.h"

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <map>

#include <beeline/error.h>
#include <beeline/io/text/arm.h>
#include <beeline/io/text/file.h>
#include <beeline/io/text/json.h>

#include <arpa/inet.h>
#include <httplib.h>

namespace beeline::command {
namespace {

constexpr std::size_t max_body = 64 * 1024;  // bytes of a POST
constexpr int threads = 64;                  // each open page takes one
constexpr int max_pages = 48;                // the other threads answer programs
constexpr int ports = 10;
constexpr double largest = 1e100;  // joint value, radians or metres
constexpr std::chrono::seconds heartbeat{1};
constexpr std::chrono::milliseconds look{50};  // how often a stream looks whether its page is open

/// What the page may load: itself, its module and its workers, and nothing from elsewhere.
constexpr const char* content_policy =
    "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; worker-src 'self' blob:; img-src "
    "'self' data: blob:; style-src 'self' 'unsafe-inline'; frame-ancestors 'self'";

std::string type_of(const std::filesystem::path& path) {
  const std::map<std::string, std::string> types{
      {".html", "text/html; charset=utf-8"}, {".js", "text/javascript"}, {".css", "text/css"},
      {".wasm", "application/wasm"},         {".svg", "image/svg+xml"},  {".png", "image/png"},
      {".json", "application/json"}};
  const auto found = types.find(path.extension().string());
  return found == types.end() ? "application/octet-stream" : found->second;
}

/// Whether a host's name is an address: 192.168.0.5 or [::1].
bool is_address(const std::string& name) {
  in_addr four{};
  in6_addr six{};
  const bool brackets = name.size() > 2 && name.front() == '[' && name.back() == ']';
  return inet_pton(AF_INET, name.c_str(), &four) == 1 ||
         (brackets && inet_pton(AF_INET6, name.substr(1, name.size() - 2).c_str(), &six) == 1);
}

void refuse(httplib::Response& response, int status, const std::string& message) {
  response.status = status;
  response.set_content(Json{{"error", Json{{"message", message}}}}.text() + "\n",
                       "application/json");
}

/// Answers with the content as it is. cpp-httplib compresses texts of set_content() where it is
/// built with Brotli, at the highest level, which takes seconds for the page; a network within
/// reach carries it in less.
void give(httplib::Response& response, std::string content, const std::string& type) {
  if (content.empty()) return response.set_content(content, type);
  const std::size_t size = content.size();
  response.set_content_provider(
      size, type,
      [text = std::move(content)](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
        return sink.write(text.data() + offset, length);
      });
}

}  // namespace

std::string PageSession::arm_document() const {
  return shaped_arm.empty() ? arm_to_json(arm) : shaped_arm;
}

PageServer::PageServer(PageSession session, const std::string& folder, std::string host)
    : session_(std::move(session)),
      folder_(std::filesystem::canonical(folder).string()),
      host_(std::move(host)) {}

PageServer::~PageServer() = default;

void PageServer::make_server() {
  server_ = std::make_unique<httplib::Server>();
  server_->new_task_queue = [] { return new httplib::ThreadPool(threads); };
  server_->set_payload_max_length(max_body);
  server_->set_read_timeout(std::chrono::seconds(5));
  server_->set_write_timeout(std::chrono::seconds(5));
  server_->set_tcp_nodelay(true);
  // The default would let two servers share a port.
  server_->set_socket_options([](socket_t socket) {
    const int yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
  });
  route();
}

int PageServer::bind(int port) {
  for (int i = 0; i < ports && port + i <= 65535; ++i) {
    make_server();  // from cpp-httplib 0.15 on, a server that failed to bind cannot bind again
    if (!server_->bind_to_port(host_, port + i)) continue;
    port_ = port + i;
    return port_;
  }
  throw Error(fmt::format("--port {}: it and the next ports of {} are not free", port, host_));
}

void PageServer::run() { server_->listen_after_bind(); }

void PageServer::stop() {
  stopped_ = true;
  changed_.notify_all();
  if (server_) server_->stop();
}

bool PageServer::comes_from_here(const httplib::Request& request) const {
  if (request.get_header_value_count("Host") != 1) return false;
  const std::string host = request.get_header_value("Host");
  const std::string port = fmt::format(":{}", port_);
  if (host.size() <= port.size() || !host.ends_with(port)) return false;
  const std::string name = host.substr(0, host.size() - port.size());
  // A page of the web can give its own name an address of this computer, but not take an address
  // for its name.
  if (name != "localhost" && name != host_ && !is_address(name)) return false;
  return !request.has_header("Origin") || request.get_header_value("Origin") == "http://" + host;
}

void PageServer::route() {
  using httplib::Request;
  using httplib::Response;
  using Routing = httplib::Server::HandlerResponse;
  server_->set_default_headers({{"X-Content-Type-Options", "nosniff"},
                                {"Content-Security-Policy", content_policy},
                                {"Cache-Control", "no-store"}});
  server_->set_pre_routing_handler([this](const Request& request, Response& response) {
    if (comes_from_here(request)) return Routing::Unhandled;
    refuse(
        response, 403,
        "requests of other sites are refused: Host must be localhost, an IP address or the host of "
        "--host, with the server's port, and Origin the same site");
    return Routing::Handled;
  });
  server_->Get("/api/session", [this](const Request&, Response& response) { session(response); });
  server_->Get("/api/events", [this](const Request&, Response& response) { events(response); });
  server_->Post("/api/joints", [this](const Request& request, Response& response) {
    const std::string type = request.get_header_value("Content-Type");
    if (type.rfind("application/json", 0) != 0) {
      return refuse(response, 415, "Content-Type must be application/json");
    }
    try {
      take_joints(request.body);
      response.status = 204;
    } catch (const std::exception& error) {
      refuse(response, 400, error.what());
    }
  });
  server_->Get(".*",
               [this](const Request& request, Response& response) { file(request, response); });
}

void PageServer::file(const httplib::Request& request, httplib::Response& response) const {
  namespace fs = std::filesystem;
  const std::string name = request.path == "/" ? "/index.html" : request.path;
  std::error_code failed;
  const fs::path path =
      name.find('\0') == std::string::npos ? fs::canonical(folder_ + name, failed) : fs::path();
  const bool inside = !failed && path.string().rfind(folder_ + "/", 0) == 0;
  if (!inside || !fs::is_regular_file(path, failed)) return refuse(response, 404, "no such file");
  std::string content = read_file(path.string());
  constexpr std::string_view body = "<body>";  // marked, so that the page asks for the session
  const std::size_t at = path.filename() == "index.html" ? content.find(body) : std::string::npos;
  if (at != std::string::npos) {
    content.replace(at, body.size(), "<body data-session=\"api/session\">");
  }
  give(response, std::move(content), type_of(path));
}

void PageServer::session(httplib::Response& response) const {
  Json answer{{"version", BEELINE_VERSION}, {"arm", session_.arm_document()}};
  answer.add("trajectory", session_.trajectory.empty() ? Json() : Json(session_.trajectory));
  answer.add("section", session_.section.empty() ? Json() : Json(session_.section));
  answer.add("scene", session_.scene.empty() ? Json() : Json(session_.scene));
  answer.add("clearance", session_.clearance ? Json(*session_.clearance) : Json());
  give(response, answer.text(), "application/json");
}

void PageServer::take_joints(const std::string& text) {
  const JsonDocument document(text, "joints");
  document.check_keys(document.root(), {"q", "time"});
  const std::size_t dof = static_cast<std::size_t>(session_.arm.dof());
  const std::vector<double> q = document.numbers(document.need(document.root(), "q"), dof);
  const Json* const time = document.find(document.root(), "time");
  for (std::size_t i = 0; i < q.size(); ++i) {
    if (std::abs(q[i]) <= largest) continue;
    throw Error(fmt::format("joints: q[{}] is {}; expected a value from -{} to {}", i, q[i],
                            largest, largest));
  }
  const Json values(
      Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(q.data(), session_.arm.dof())));
  std::string joints = values.text();
  std::erase(joints, '\n');
  if (time != nullptr) joints += fmt::format(", \"time\": {}", Json(document.number(*time)).text());
  {
    const std::lock_guard lock(mutex_);
    latest_ = std::move(joints);
    ++sequence_;
  }
  changed_.notify_all();
}

std::string PageServer::next_event(std::uint64_t& seen, const std::function<bool()>& is_open) {
  std::unique_lock lock(mutex_);
  const auto changed = [&] { return stopped_ || sequence_ != seen; };
  for (auto waited = look; !changed_.wait_for(lock, look, changed); waited += look) {
    lock.unlock();
    if (waited >= heartbeat || !is_open()) return {};
    lock.lock();
  }
  seen = sequence_;
  return fmt::format("event: joints\ndata: {{\"q\": {}, \"sequence\": {}}}\n\n", latest_, seen);
}

void PageServer::events(httplib::Response& response) {
  struct Page {
    bool greeted = false;
    std::uint64_t seen = 0;
  };
  if (++pages_ > max_pages) {
    --pages_;
    return refuse(response, 503, fmt::format("{} pages are open already", max_pages));
  }
  const std::shared_ptr<Page> page(new Page, [this](Page* closed) {
    delete closed;
    --pages_;
  });
  response.set_chunked_content_provider("text/event-stream", [this, page](std::size_t,
                                                                          httplib::DataSink& sink) {
    // The first answer comes at once, so that the page knows that it is connected.
    std::string event = page->greeted ? next_event(page->seen, sink.is_writable) : ": welcome\n\n";
    page->greeted = true;
    if (stopped_) {
      sink.done();
      return false;
    }
    if (event.empty()) event = ": still here\n\n";  // fails where the page is closed
    return sink.write(event.data(), event.size());
  });
}

}  // namespace beeline::command
