// SPDX-License-Identifier: Apache-2.0
#include "nef/io/zip_archive.h"

#include <zip.h>

#include <ctime>

#include <algorithm>
#include <array>

#include "nef/base/text/in_quotes.h"
#include "nef/io/file_bytes.h"

namespace nef {

struct ZipArchive::Handle {
  zip_t* zip = nullptr;
  const std::string& path;

  [[noreturn]] void fail(FileProblem problem, const std::string& what) const {
    throw FileError(problem, path + ": " + what);
  }
};

namespace {

// Of this thread, of which a loaded machine does not use up more.
std::chrono::nanoseconds processor_time() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return std::chrono::seconds(now.tv_sec) + std::chrono::nanoseconds(now.tv_nsec);
}

}  // namespace

ZipArchive::ZipArchive(std::string_view bytes, const std::string& path, unsigned seconds)
    : handle_(new Handle{nullptr, path}),
      left_(std::max(std::size_t{64} << 20U, kMostGrowth * bytes.size())),
      seconds_(seconds),
      begin_(processor_time()) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
  if (source != nullptr) handle_->zip = zip_open_from_source(source, ZIP_RDONLY, &error);
  const std::string what = handle_->zip == nullptr ? zip_error_strerror(&error) : "";
  if (handle_->zip == nullptr && source != nullptr) zip_source_free(source);
  zip_error_fini(&error);
  if (handle_->zip == nullptr) {
    handle_->fail(FileProblem::kSyntax, "not a zip archive, or its end is missing (" + what + ")");
  }
}

ZipArchive::~ZipArchive() {
  if (handle_->zip != nullptr) zip_discard(handle_->zip);
}

bool ZipArchive::contains(const std::string& name) const {
  return zip_name_locate(handle_->zip, name.c_str(), ZIP_FL_NOCASE) >= 0;
}

void ZipArchive::read(const std::string& name, const std::function<void(std::string_view)>& sink) {
  const std::string file = "the file " + in_quotes(name) + " in it ";
  zip_stat_t about;
  const bool known = zip_stat(handle_->zip, name.c_str(), ZIP_FL_NOCASE, &about) == 0;
  // Others may take gigabytes to unpack a few bytes.
  if (known && about.comp_method != ZIP_CM_STORE && about.comp_method != ZIP_CM_DEFLATE) {
    handle_->fail(FileProblem::kUnsupported, file + "is packed in an unusual way; unpack and repack it with deflate");
  }
  const std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> stream(zip_fopen(handle_->zip, name.c_str(), ZIP_FL_NOCASE),
                                                                 zip_fclose);
  if (!stream) handle_->fail(FileProblem::kSyntax, file + "cannot be read: " + zip_strerror(handle_->zip));
  std::array<char, 1U << 16U> buffer;
  for (;;) {
    const zip_int64_t count = zip_fread(stream.get(), buffer.data(), buffer.size());
    if (count < 0) {
      handle_->fail(FileProblem::kTruncated, file + "is damaged: " + zip_file_strerror(stream.get()));
    }
    if (count == 0) return;
    const auto size = static_cast<std::size_t>(count);
    if (size > left_) handle_->fail(FileProblem::kUnsupported, file + "is suspiciously large; unpack and repack it");
    left_ -= size;
    if (processor_time() - begin_ > std::chrono::seconds(seconds_)) {
      handle_->fail(FileProblem::kUnsupported, file + "takes more than " + std::to_string(seconds_) +
                                                   " s to unpack and parse; it is damaged, or else split it");
    }
    sink({buffer.data(), size});
  }
}

std::string zip_bytes(const std::vector<std::pair<std::string, std::string>>& files) {
  // What goes wrong here is lack of memory.
  const auto require = [](bool good) {
    if (!good) throw std::bad_alloc();
  };
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* target = zip_source_buffer_create(nullptr, 0, 0, &error);
  require(target != nullptr);
  zip_t* zip = zip_open_from_source(target, ZIP_TRUNCATE, &error);
  require(zip != nullptr);
  zip_source_keep(target);  // closing the archive would free it
  for (const auto& [name, content] : files) {
    zip_source_t* source = zip_source_buffer(zip, content.data(), content.size(), 0);
    require(source != nullptr);
    const zip_int64_t index = zip_file_add(zip, name.c_str(), source, ZIP_FL_ENC_UTF_8);
    require(index >= 0);
    constexpr zip_uint16_t kFirstDay = (1U << 5U) | 1U;  // 1 January 1980
    require(zip_file_set_dostime(zip, static_cast<zip_uint64_t>(index), 0, kFirstDay, 0) == 0);
  }
  require(zip_close(zip) == 0);
  zip_stat_t stat;
  require(zip_source_stat(target, &stat) == 0 && zip_source_open(target) == 0);
  std::string bytes(stat.size, '\0');
  require(zip_source_read(target, bytes.data(), bytes.size()) == static_cast<zip_int64_t>(bytes.size()));
  zip_source_close(target);
  zip_source_free(target);
  return bytes;
}

}  // namespace nef
