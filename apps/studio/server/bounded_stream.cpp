// SPDX-License-Identifier: Apache-2.0
#include "apps/studio/server/bounded_stream.h"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace nef::studio {

BoundedStream::BoundedStream(socket_t socket, const ServerLimits& limits)
    : socket_(socket), limits_(limits), left_(limits.most_head), read_until_(Clock::now() + limits.head_time) {}

void BoundedStream::expect_body(std::size_t bytes) {
  left_ = bytes;
  read_until_ = Clock::now() + limits_.body_time;
}

bool BoundedStream::wait(short event, Clock::time_point until) const {
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now()).count();
    if (left <= 0) return false;
    pollfd question{socket_, event, 0};
    const int answer = ::poll(&question, 1, static_cast<int>(left));
    if (answer > 0) return true;
    if (answer == 0 || errno != EINTR) return false;
  }
}

bool BoundedStream::is_readable() const { return begin_ < end_ || wait(POLLIN, read_until_); }

bool BoundedStream::is_writable() const { return true; }

ssize_t BoundedStream::read(char* bytes, std::size_t size) {
  if (size == 0) return 0;
  if (left_ == 0) return -1;
  if (begin_ == end_) {
    if (!wait(POLLIN, read_until_)) return -1;
    const ssize_t got = ::recv(socket_, buffer_.data(), buffer_.size(), 0);
    if (got <= 0) return got;
    begin_ = 0;
    end_ = static_cast<std::size_t>(got);
  }
  const std::size_t count = std::min({size, end_ - begin_, left_});
  std::memcpy(bytes, buffer_.data() + begin_, count);
  begin_ += count;
  left_ -= count;
  return static_cast<ssize_t>(count);
}

ssize_t BoundedStream::write(const char* bytes, std::size_t size) {
  if (write_until_ == Clock::time_point{}) write_until_ = Clock::now() + limits_.reply_time;
  if (!wait(POLLOUT, write_until_)) return -1;
  return ::send(socket_, bytes, size, MSG_NOSIGNAL | MSG_DONTWAIT);
}

// Nobody asks: the server is on the loopback.
void BoundedStream::get_remote_ip_and_port(std::string& ip, int& port) const {
  ip.clear();
  port = 0;
}

void BoundedStream::get_local_ip_and_port(std::string& ip, int& port) const { get_remote_ip_and_port(ip, port); }

}  // namespace nef::studio
