// SPDX-License-Identifier: Apache-2.0
//
// cpp-httplib's server with another way to serve a connection: over a BoundedStream, with what it may send bounded by
// the head until the head was let in, and with a fixed number of threads. Connections beyond that number are refused by
// the thread that accepts them, so nothing queues up. A request is asked about twice: before its body may come in, and
// where cpp-httplib allows a reply without reading the body.
#include "apps/studio/server/loopback_server.h"

#include <httplib.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <thread>

#include "apps/studio/server/admission.h"
#include "apps/studio/server/bounded_stream.h"
#include "nef/base/error.h"

namespace nef::studio {
namespace {

// Hands connections to threads as long as some are idle; the others to `refuse_one`, which ends them at once.
class ConnectionQueue : public httplib::TaskQueue {
 public:
  explicit ConnectionQueue(std::size_t threads) : pool_(threads), most_(threads) {}

  void enqueue(std::function<void()> serve) override {
    if (busy_ >= most_) {
      serve();  // by the accepting thread, which refuses
      return;
    }
    ++busy_;
    pool_.enqueue([this, serve = std::move(serve)] {
      serve();
      --busy_;
    });
  }
  void shutdown() override { pool_.shutdown(); }

 private:
  httplib::ThreadPool pool_;
  std::size_t most_;
  std::atomic<std::size_t> busy_{0};
};

std::optional<std::string> header(const httplib::Request& request, const char* name) {
  if (!request.has_header(name)) return std::nullopt;
  return request.get_header_value(name);
}

RequestHead head_of(const httplib::Request& request) {
  RequestHead head;
  head.method = request.method;
  head.path = request.path;
  head.host = header(request, "Host");
  head.origin = header(request, "Origin");
  head.token = header(request, "X-Nef-Token");
  if (!head.token && request.has_param("token")) head.token = request.get_param_value("token");
  head.content_length = header(request, "Content-Length");
  head.has_encoding = request.has_header("Content-Encoding") || request.has_header("Transfer-Encoding") ||
                      request.is_multipart_form_data();
  return head;
}

void send_reply(const WebReply& reply, httplib::Response& response) {
  response.status = reply.status;
  response.set_content(reply.body, reply.type.c_str());
  for (const auto& [name, value] : reply.headers) response.set_header(name.c_str(), value);
  response.set_header("Connection", "close");
  response.set_header("Cache-Control", "no-store");
  response.set_header("Referrer-Policy", "no-referrer");
  response.set_header("X-Content-Type-Options", "nosniff");
  response.set_header("X-Frame-Options", "DENY");
  response.set_header("Cross-Origin-Resource-Policy", "same-origin");
}

constexpr char kTooMany[] =
    "HTTP/1.1 503 Service Unavailable\r\nContent-Type: text/plain; charset=utf-8\r\nContent-Length: 38\r\n"
    "Connection: close\r\n\r\nthere are too many connections at once";

// Ends a connection. What a client is still sending is read for a moment: the system drops a reply that was not taken
// yet if bytes are left unread.
void end_connection(socket_t socket) {
  ::shutdown(socket, SHUT_WR);
  std::array<char, 16384> rest{};
  for (int i = 0; i < 64; ++i) {
    pollfd question{socket, POLLIN, 0};
    if (::poll(&question, 1, 100) <= 0 || ::recv(socket, rest.data(), rest.size(), 0) <= 0) break;
  }
  ::close(socket);
}

}  // namespace

class LoopbackServer::Implementation : public httplib::Server {
 public:
  Implementation(std::uint16_t port, std::string token, const ServerLimits& limits, WebHandler handler)
      : token_(std::move(token)), limits_(limits), handler_(std::move(handler)) {
    new_task_queue = [this] { return new ConnectionQueue(limits_.most_connections); };
    // Not SO_REUSEPORT, with which another process could share the port.
    set_socket_options([](socket_t socket) {
      const int yes = 1;
      ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
    set_payload_max_length(limits_.most_body);
    set_expect_100_continue_handler([](const httplib::Request&, httplib::Response&) { return 417; });
    set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
      if (const auto refusal = refuse(head_of(request), token_, port_, limits_)) {
        send_reply(line_reply(refusal->status, refusal->line), response);
        return HandlerResponse::Handled;
      }
      return HandlerResponse::Unhandled;
    });
    const Handler answer = [this](const httplib::Request& request, httplib::Response& response) {
      try {
        send_reply(handler_({request.method, request.path, request.body}), response);
      } catch (const std::exception& error) {
        send_reply(line_reply(500, error.what()), response);
      }
    };
    Get("/[a-z/_]*", answer);
    Post("/[a-z/_]*", answer);
    set_error_handler([](const httplib::Request&, httplib::Response& response) {
      if (response.body.empty()) send_reply(line_reply(response.status, "the request is not understood"), response);
    });
    const int bound = port == 0 ? bind_to_any_port("127.0.0.1") : (bind_to_port("127.0.0.1", port) ? port : -1);
    if (bound <= 0) {
      throw InputError("port " + std::to_string(port) +
                       " cannot be had: another program has it; choose another --port");
    }
    port_ = static_cast<std::uint16_t>(bound);
  }

  [[nodiscard]] std::uint16_t port() const { return port_; }
  [[nodiscard]] const std::string& token() const { return token_; }

  void serve() {
    acceptor_ = std::this_thread::get_id();
    // It ends by itself where accepting fails, for a connection that was broken off meanwhile, say.
    while (!stopped_ && !listen_after_bind() && !stopped_ && bind_to_port("127.0.0.1", port_)) {
    }
  }
  void end() {
    stopped_ = true;
    stop();
  }

 private:
  bool process_and_close_socket(socket_t socket) override {
    if (std::this_thread::get_id() == acceptor_) {
      // Without waiting: nobody else is accepted meanwhile.
      std::array<char, 4096> request{};
      static_cast<void>(::recv(socket, request.data(), request.size(), MSG_DONTWAIT));
      static_cast<void>(::send(socket, kTooMany, sizeof kTooMany - 1, MSG_NOSIGNAL | MSG_DONTWAIT));
      ::close(socket);
      return false;
    }
    BoundedStream stream(socket, limits_);
    bool closed = false;
    const bool served = process_request(stream, true, closed, [&](httplib::Request& request) {
      const RequestHead head = head_of(request);
      if (!refuse(head, token_, port_, limits_)) stream.expect_body(body_length(head.content_length).value_or(0));
      // On the loopback compression costs more than it gains; parts of replies are not asked for.
      request.headers.erase("Accept-Encoding");
      request.ranges.clear();
    });
    end_connection(socket);
    return served;
  }

  std::string token_;
  ServerLimits limits_;
  WebHandler handler_;
  std::uint16_t port_ = 0;
  std::atomic<bool> stopped_{false};
  std::thread::id acceptor_;
};

LoopbackServer::LoopbackServer(std::uint16_t port, std::string token, const ServerLimits& limits, WebHandler handler)
    : implementation_(std::make_unique<Implementation>(port, std::move(token), limits, std::move(handler))) {}
LoopbackServer::~LoopbackServer() = default;

std::uint16_t LoopbackServer::port() const { return implementation_->port(); }
std::string LoopbackServer::address() const {
  return "http://127.0.0.1:" + std::to_string(port()) + "/?token=" + implementation_->token();
}
void LoopbackServer::run() { implementation_->serve(); }
void LoopbackServer::stop() { implementation_->end(); }

}  // namespace nef::studio
