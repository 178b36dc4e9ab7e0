#include "polder/stage/checkpoint.hpp"

#include <hdf5.h>

#include <cstring>
#include <type_traits>

namespace polder {

namespace {

constexpr char mark[] = "polder-1";  // 8 bytes and the terminating zero that is not written
constexpr std::size_t tail = 16;     // checksum and mark

struct Handle {
  hid_t id;
  herr_t (*close)(hid_t);
  Handle(hid_t id_, herr_t (*close_)(hid_t)) : id(id_), close(close_) {
    if (id < 0) throw CheckpointError("HDF5 refuses the data of the checkpoint");
  }
  ~Handle() { close(id); }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
};

template <class T>
hid_t type_of() {
  if constexpr (std::is_same_v<T, double>) return H5T_NATIVE_DOUBLE;
  if constexpr (std::is_same_v<T, std::uint64_t>) return H5T_NATIVE_UINT64;
  if constexpr (std::is_same_v<T, std::int32_t>) return H5T_NATIVE_INT32;
  return H5T_NATIVE_UINT8;
}

/// Groups on the way to a data set are made as needed.
Handle link_properties() {
  Handle properties(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(properties.id, 1);
  return {H5Pcopy(properties.id), H5Pclose};
}

template <class T>
void write(hid_t file, const std::string& name, const T* values, std::size_t count) {
  const hsize_t extent = count;
  const Handle space(H5Screate_simple(1, &extent, nullptr), H5Sclose);
  const Handle links = link_properties();
  const Handle set(H5Dcreate2(file, name.c_str(), type_of<T>(), space.id, links.id, H5P_DEFAULT, H5P_DEFAULT),
                   H5Dclose);
  if (count > 0 && H5Dwrite(set.id, type_of<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0)
    throw CheckpointError("HDF5 cannot write '" + name + "'");
}

/// A data set of a checkpoint, in one piece as it is written. Its length is what the file says, and at most what the
/// file has room for: nothing larger is ever allocated for it.
class Stored {
 public:
  Stored(hid_t file, std::string name, std::size_t bytes_of_file)
      : name_(std::move(name)), set_(H5Dopen2(file, name_.c_str(), H5P_DEFAULT), H5Dclose) {
    const Handle space(H5Dget_space(set_.id), H5Sclose);
    const Handle creation(H5Dget_create_plist(set_.id), H5Pclose);
    const Handle type(H5Dget_type(set_.id), H5Tclose);
    const hssize_t length = H5Sget_simple_extent_npoints(space.id);
    const std::size_t width = H5Tget_size(type.id);
    if (H5Pget_layout(creation.id) != H5D_CONTIGUOUS || length < 0 || width == 0 ||
        static_cast<std::size_t>(length) > bytes_of_file / width)
      throw CheckpointError("'" + name_ + "' is not stored as a run stores it");
    length_ = static_cast<std::size_t>(length);
    width_ = width;
  }

  std::size_t length() const { return length_; }

  template <class T>
  void read(T* values, std::size_t count) const {
    if (length_ != count || width_ != sizeof(T)) throw CheckpointError("'" + name_ + "' has another length");
    if (count > 0 && H5Dread(set_.id, type_of<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0)
      throw CheckpointError("HDF5 cannot read '" + name_ + "'");
  }

 private:
  std::string name_;
  Handle set_;
  std::size_t length_ = 0, width_ = 0;
};

/// archive(name, value or array) that writes.
struct Writer {
  hid_t file;
  template <class T>
  void operator()(const std::string& name, T& value) const {
    if constexpr (std::is_arithmetic_v<T>)
      write(file, name, &value, 1);
    else
      write(file, name, value.data(), value.size());
  }
};

/// archive(name, value or array) that reads. Arrays over points take the length that is stored, those over the grid
/// must have it.
struct Reader {
  hid_t file;
  std::size_t bytes;  ///< of the file
  template <class T>
  void operator()(const std::string& name, T& value) const {
    const Stored stored(file, name, bytes);
    if constexpr (std::is_arithmetic_v<T>) {
      stored.read(&value, 1);
    } else {
      if (name.starts_with("soil/") || name.starts_with("water/") || name == "output/followed")
        value.resize(stored.length());
      stored.read(value.data(), value.size());
    }
  }
};

template <class Archive>
void each_output(OutputState& output, Archive&& archive) {
  archive("output/history_rows", output.history_rows);
  archive("output/next_history", output.next_history);
  archive("output/next_snapshot", output.next_snapshot);
  archive("output/next_picture", output.next_picture);
  archive("output/wall_seconds", output.wall_seconds);
  archive("output/last_dt", output.last_dt);
  archive("output/followed", output.followed);
}

/// Of a file of HDF5's that lives in memory. One of that name must not be on the disk: HDF5 looks, and then refuses the
/// image that it was given.
constexpr const char* nowhere = "/dev/null/checkpoint";

Handle in_memory() {
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_core(access.id, 1 << 20, 0);
  return {H5Pcopy(access.id), H5Pclose};
}

}  // namespace

std::uint64_t checksum(const char* bytes, std::size_t count) {
  std::uint64_t hash = 0xCBF29CE484222325ULL;
  for (std::size_t i = 0; i < count; ++i) hash = (hash ^ static_cast<unsigned char>(bytes[i])) * 0x100000001B3ULL;
  return hash;
}

template <class Space>
std::string checkpoint_bytes(Simulation<Space>& run, const OutputState& output, const std::string& case_text) {
  const Handle access = in_memory();
  const Handle file(H5Fcreate(nowhere, H5F_ACC_TRUNC, H5P_DEFAULT, access.id), H5Fclose);
  write(file.id, "case", reinterpret_cast<const std::uint8_t*>(case_text.data()), case_text.size());
  OutputState copy = output;
  each_output(copy, Writer{file.id});
  run.each_state(Writer{file.id});
  H5Fflush(file.id, H5F_SCOPE_GLOBAL);
  const auto size = H5Fget_file_image(file.id, nullptr, 0);
  if (size <= 0) throw CheckpointError("HDF5 cannot give the bytes of the checkpoint");
  std::string bytes(static_cast<std::size_t>(size), '\0');
  H5Fget_file_image(file.id, bytes.data(), bytes.size());
  const std::uint64_t sum = checksum(bytes.data(), bytes.size());
  bytes.append(reinterpret_cast<const char*>(&sum), sizeof sum);
  bytes.append(mark, 8);
  return bytes;
}

template <class Space>
OutputState restore_checkpoint(const std::string& bytes, Simulation<Space>& run, const std::string& case_text) {
  if (bytes.size() < tail || std::memcmp(bytes.data() + bytes.size() - 8, mark, 8) != 0)
    throw CheckpointError("it is cut off or no checkpoint of this version");
  std::uint64_t sum = 0;
  std::memcpy(&sum, bytes.data() + bytes.size() - tail, sizeof sum);
  if (checksum(bytes.data(), bytes.size() - tail) != sum) throw CheckpointError("its checksum does not match");

  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // errors are ours to report
  const Handle access = in_memory();
  std::string image = bytes.substr(0, bytes.size() - tail);
  H5Pset_file_image(access.id, image.data(), image.size());
  const Handle file(H5Fopen(nowhere, H5F_ACC_RDONLY, access.id), H5Fclose);
  const Stored stored_case(file.id, "case", image.size());
  std::string of(stored_case.length(), '\0');
  stored_case.read(reinterpret_cast<std::uint8_t*>(of.data()), of.size());
  if (of != case_text) throw CheckpointError("it belongs to another case: the case file has changed since");
  OutputState output;
  each_output(output, Reader{file.id, image.size()});
  run.each_state(Reader{file.id, image.size()});
  if (const std::string flaw = run.flaw(); !flaw.empty()) throw CheckpointError("its state cannot be: " + flaw);
  run.restored();
  return output;
}

template std::string checkpoint_bytes(Simulation<PlaneStrain>&, const OutputState&, const std::string&);
template std::string checkpoint_bytes(Simulation<Solid>&, const OutputState&, const std::string&);
template OutputState restore_checkpoint(const std::string&, Simulation<PlaneStrain>&, const std::string&);
template OutputState restore_checkpoint(const std::string&, Simulation<Solid>&, const std::string&);

}  // namespace polder
