#pragma once
// The one exception of everything that writes results: which path, and why. The command line turns it into exit
// status 4; files written before stay as they were.
#include <stdexcept>
#include <string>

namespace polder {

class OutputError : public std::runtime_error {
 public:
  OutputError(std::string path, std::string reason)
      : std::runtime_error("cannot write " + path + ": " + reason),
        path_(std::move(path)),
        reason_(std::move(reason)) {}
  const std::string& path() const { return path_; }
  const std::string& reason() const { return reason_; }

 private:
  std::string path_, reason_;
};

}  // namespace polder
