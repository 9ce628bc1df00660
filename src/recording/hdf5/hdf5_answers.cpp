#include "recording/hdf5/hdf5_answers.h"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <csignal>
#include <new>
#include <string_view>
#include <utility>
#include <vector>

#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

namespace palpate {
namespace {

constexpr std::size_t kMaxDataSets = 10'000;
constexpr std::size_t kMaxNameBytes = 4096;
constexpr hsize_t kMaxReadChunkBytes = 32u << 20;
constexpr std::size_t kAllNamesBytes = 4u << 20;
constexpr std::size_t kTextsPerAnswerBytes = 1u << 20;
constexpr hsize_t kTextsPerAnswer = 4096;
// Chunks that are kept of one array, and of all.
constexpr hsize_t kKeptChunksBytes = 32u << 20;
constexpr std::size_t kAllKeptChunksBytes = 64u << 20;
constexpr std::size_t kMaxChunkSlots = 1u << 20;

struct Hdf5Fault {
  std::string text;
};
[[noreturn]] void fault(std::string text) { throw Hdf5Fault{std::move(text)}; }

struct CollectedNames {
  std::vector<std::string> names;
  std::size_t bytes = 0;
};

// `Info`: HDF5 1.12 has other records of an object than 1.10.
template <typename Info>
herr_t collectName(hid_t, const char* name, const Info* info, void* data) {
  auto& collected = *static_cast<CollectedNames*>(data);
  if (info->type != H5O_TYPE_DATASET) return 0;
  const std::string_view text = name;
  if (text.size() > kAllNamesBytes - collected.bytes) return 1;
  collected.bytes += text.size();
  collected.names.emplace_back(text);
  return collected.names.size() >= kMaxDataSets ? 1 : 0;
}

Hdf5Kind kindOf(hid_t type) {
  switch (H5Tget_class(type)) {
    case H5T_INTEGER:
      return Hdf5Kind::kInteger;
    case H5T_FLOAT:
      return Hdf5Kind::kFloat;
    case H5T_STRING:
      return Hdf5Kind::kText;
    default:
      return Hdf5Kind::kOther;
  }
}

std::string hdf5TypeName(hid_t type) {
  const std::string bits = std::to_string(8 * H5Tget_size(type));
  switch (H5Tget_class(type)) {
    case H5T_INTEGER:
      return (H5Tget_sign(type) == H5T_SGN_NONE ? "uint" : "int") + bits;
    case H5T_FLOAT:
      return "float" + bits;
    case H5T_STRING:
      return "text";
    case H5T_ENUM:
      return "enum";
    case H5T_COMPOUND:
      return "structure";
    case H5T_VLEN:
      return "lists of different lengths";
    case H5T_REFERENCE:
      return "references";
    default:
      return "other";
  }
}

hid_t memoryTypeOf(Hdf5Number type) {
  switch (type) {
    case Hdf5Number::kU8:
      return H5T_NATIVE_UINT8;
    case Hdf5Number::kI32:
      return H5T_NATIVE_INT32;
    case Hdf5Number::kI64:
      return H5T_NATIVE_INT64;
    case Hdf5Number::kF32:
      return H5T_NATIVE_FLOAT;
    case Hdf5Number::kF64:
      break;
  }
  return H5T_NATIVE_DOUBLE;
}

// Why the values of a data set can't be read; empty: nothing is known.
std::string filterFault(hid_t properties) {
  const int numFilters = H5Pget_nfilters(properties);
  for (int i = 0; i < numFilters; ++i) {
    unsigned flags = 0;
    std::size_t numValues = 0;
    char name[64] = "";
    const H5Z_filter_t filter = H5Pget_filter2(properties,
                                               static_cast<unsigned>(i),
                                               &flags,
                                               &numValues,
                                               nullptr,
                                               sizeof name,
                                               name,
                                               nullptr);
    if (filter < 0 || H5Zfilter_avail(filter) <= 0)
      return "is compressed with a filter that is not available (" + std::to_string(filter) +
             (name[0] ? ", " + std::string(name) : "") + "); write it with gzip or without";
  }
  return {};
}

// Number of chunks that a data set of this shape consists of.
hsize_t chunksOf(const std::vector<hsize_t>& shape, const std::vector<hsize_t>& chunk) {
  hsize_t count = 1;
  for (std::size_t d = 0; d < shape.size(); ++d) {
    const hsize_t along = chunk[d] == 0 ? 0 : (shape[d] - 1) / chunk[d] + 1;
    if (shape[d] == 0) return 0;
    if (__builtin_mul_overflow(count, along, &count)) return HSIZE_UNDEF;
  }
  return count;
}

// The same for what a data set claims to hold: values that were never written are not read as if
// they were there.
std::string storageFault(hid_t id, hid_t properties, hid_t space, Hdf5Facts& facts) {
  constexpr const char* kMissing =
      "claims more values than the file holds: some were never written";
  const std::vector<hsize_t> shape(facts.shape.begin(), facts.shape.end());
  const Hdf5Id type(H5Dget_type(id), H5Tclose);
  hsize_t bytes = H5Tget_size(type.get());
  if (H5Pget_layout(properties) != H5D_CHUNKED) {
    for (const hsize_t length : shape)
      if (__builtin_mul_overflow(bytes, length, &bytes)) return kMissing;
    return H5Dget_storage_size(id) < bytes ? kMissing : "";
  }
  std::vector<hsize_t> chunk(shape.size());
  H5Pget_chunk(properties, static_cast<int>(chunk.size()), chunk.data());
  for (const hsize_t length : chunk)
    if (__builtin_mul_overflow(bytes, length, &bytes) || bytes > kMaxReadChunkBytes)
      return "has chunks that are too large to be read";
  if (!chunk.empty()) facts.chunkLength = chunk[0];
  hsize_t stored = 0;
  if (H5Dget_num_chunks(id, space, &stored) < 0) return "can't be read: damaged";
  return stored < chunksOf(shape, chunk) ? kMissing : "";
}

Hdf5Facts factsOf(hid_t id) {
  const Hdf5Id properties(H5Dget_create_plist(id), H5Pclose);
  // Before the library looks for the other files.
  if (H5Pget_layout(properties.get()) == H5D_VIRTUAL)
    fault("is assembled from other data sets (virtual layout), which is refused");
  if (H5Pget_external_count(properties.get()) != 0)
    fault("is stored in other files (external storage), which is refused");
  const Hdf5Id type(H5Dget_type(id), H5Tclose);
  const Hdf5Id space(H5Dget_space(id), H5Sclose);
  Hdf5Facts facts;
  facts.kind = kindOf(type.get());
  facts.typeName = hdf5TypeName(type.get());
  const int rank = H5Sget_simple_extent_ndims(space.get());
  if (rank < 0) fault("can't be opened: damaged");
  std::vector<hsize_t> shape(static_cast<std::size_t>(rank));
  H5Sget_simple_extent_dims(space.get(), shape.data(), nullptr);
  facts.shape.assign(shape.begin(), shape.end());
  facts.fault = filterFault(properties.get());
  if (facts.fault.empty()) facts.fault = storageFault(id, properties.get(), space.get(), facts);
  return facts;
}

// Returns the sizes of what is selected.
std::vector<hsize_t> selectRows(hid_t space,
                                const Hdf5Facts& facts,
                                hsize_t first,
                                hsize_t count,
                                Hdf5Id& memory,
                                Hdf5Axis axis = Hdf5Axis::kFirst) {
  std::vector<hsize_t> start(facts.shape.size(), 0);
  std::vector<hsize_t> size(facts.shape.begin(), facts.shape.end());
  if (size.empty()) fault("has fewer rows");
  const std::size_t along = axis == Hdf5Axis::kFirst ? 0 : size.size() - 1;
  if (first > size[along] || count > size[along] - first) fault("has fewer rows");
  start[along] = first;
  size[along] = count;
  memory = Hdf5Id(H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr), H5Sclose);
  if (H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, size.data(), nullptr) < 0)
    fault("can't be read: damaged or cut off");
  return size;
}

// The chunks that a row of an array crosses; 0 bytes: it has none, or they are too large to be
// counted.
struct ChunkBand {
  hsize_t bytes = 0;
  std::size_t slots = 0;  // of a table of chunks in which those of a band have different places
};

ChunkBand chunkBandOf(hid_t id, const Hdf5Facts& facts) {
  const Hdf5Id properties(H5Dget_create_plist(id), H5Pclose);
  if (H5Pget_layout(properties.get()) != H5D_CHUNKED) return {};
  const Hdf5Id type(H5Dget_type(id), H5Tclose);
  std::vector<hsize_t> chunk(facts.shape.size());
  H5Pget_chunk(properties.get(), static_cast<int>(chunk.size()), chunk.data());
  // A text of any length is a length u32 and a place (u64, u32) in the file.
  constexpr hsize_t kTextBytes = 16;
  ChunkBand band{H5Tis_variable_str(type.get()) > 0 ? kTextBytes : H5Tget_size(type.get()), 1};
  for (std::size_t d = 0; d < chunk.size(); ++d) {
    if (chunk[d] == 0 || __builtin_mul_overflow(band.bytes, chunk[d], &band.bytes)) return {};
    if (d == 0) continue;
    const hsize_t along = (facts.shape[d] + chunk[d] - 1) / chunk[d];
    if (__builtin_mul_overflow(band.bytes, along, &band.bytes) || band.bytes > kKeptChunksBytes)
      return {};
    // The library's places are bit fields of the numbers of a chunk.
    band.slots *= std::bit_ceil(static_cast<std::size_t>(along));
    if (band.slots > kMaxChunkSlots) return {};
  }
  return band;
}

// With room for the chunks of a band.
Hdf5Id openArray(hid_t file, const std::string& name, const ChunkBand& kept) {
  const Hdf5Id access(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose);
  H5Pset_chunk_cache(access.get(), kept.slots, static_cast<std::size_t>(kept.bytes), 1.0);
  Hdf5Id opened(H5Dopen2(file, name.c_str(), access.get()), H5Dclose);
  if (!opened.ok()) fault("can't be opened: damaged, or no data set");
  return opened;
}

constexpr std::size_t kMaxAxes = 8;
constexpr std::size_t kMaxAxisNameBytes = 256;

// An attribute with an element of this class for each axis, opened; nothing: there is none.
Hdf5Id axisAttribute(hid_t array, const char* name, H5T_class_t kind, std::size_t numAxes) {
  if (H5Aexists(array, name) <= 0) return {};
  Hdf5Id attribute(H5Aopen(array, name, H5P_DEFAULT), H5Aclose);
  if (!attribute.ok()) return {};
  const Hdf5Id type(H5Aget_type(attribute.get()), H5Tclose);
  const Hdf5Id space(H5Aget_space(attribute.get()), H5Sclose);
  const hssize_t count = H5Sget_simple_extent_npoints(space.get());
  if (H5Tget_class(type.get()) != kind || count != static_cast<hssize_t>(numAxes)) return {};
  return attribute;
}

// DIMENSION_LABELS: texts of any length.
void readAxisLabels(hid_t array, std::vector<std::string>& names) {
  const Hdf5Id attribute = axisAttribute(array, "DIMENSION_LABELS", H5T_STRING, names.size());
  if (!attribute.ok()) return;
  const Hdf5Id type(H5Aget_type(attribute.get()), H5Tclose);
  if (H5Tis_variable_str(type.get()) <= 0) return;
  const Hdf5Id memory(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(memory.get(), H5T_VARIABLE);
  H5Tset_cset(memory.get(), H5Tget_cset(type.get()));
  std::vector<char*> texts(names.size(), nullptr);
  if (H5Aread(attribute.get(), memory.get(), static_cast<void*>(texts.data())) < 0) return;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (texts[i]) names[i] = std::string_view(texts[i]).substr(0, kMaxAxisNameBytes);
    H5free_memory(texts[i]);
  }
}

// DIMENSION_LIST: for each axis a list of references to its scales, of which the first one names
// it.
void readAxisScales(hid_t array, std::vector<std::string>& names) {
  const Hdf5Id attribute = axisAttribute(array, "DIMENSION_LIST", H5T_VLEN, names.size());
  if (!attribute.ok()) return;
  const Hdf5Id type(H5Aget_type(attribute.get()), H5Tclose);
  const Hdf5Id element(H5Tget_super(type.get()), H5Tclose);
  if (H5Tequal(element.get(), H5T_STD_REF_OBJ) <= 0) return;
  const Hdf5Id memory(H5Tvlen_create(H5T_STD_REF_OBJ), H5Tclose);
  const Hdf5Id space(H5Aget_space(attribute.get()), H5Sclose);
  std::vector<hvl_t> lists(names.size());
  if (H5Aread(attribute.get(), memory.get(), lists.data()) < 0) return;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (lists[i].len == 0 || !names[i].empty()) continue;
    std::string path(kMaxAxisNameBytes, '\0');
    const ssize_t length = H5Rget_name(array, H5R_OBJECT, lists[i].p, path.data(), path.size());
    if (length <= 0) continue;
    path.resize(std::min(static_cast<std::size_t>(length), path.size() - 1));
    names[i] = path.substr(path.rfind('/') + 1);
  }
  H5Dvlen_reclaim(memory.get(), space.get(), H5P_DEFAULT, lists.data());
}

bool receiveAll(int socket, void* bytes, std::size_t count) {
  auto* next = static_cast<char*>(bytes);
  while (count > 0) {
    const ssize_t got = ::recv(socket, next, count, 0);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    next += got;
    count -= static_cast<std::size_t>(got);
  }
  return true;
}

bool sendAll(int socket, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t sent = ::send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(sent));
  }
  return true;
}

// The next request may use so much processor time; then the system ends the process (SIGPROF).
// RLIMIT_CPU counts whole seconds only.
void limitNextRequest(std::chrono::milliseconds cpu) {
  itimerval limit{};
  limit.it_value.tv_sec = static_cast<time_t>(cpu.count() / 1000);
  limit.it_value.tv_usec = static_cast<suseconds_t>(cpu.count() % 1000 * 1000);
  ::setitimer(ITIMER_PROF, &limit, nullptr);
}

void limitHdf5Process() {
  const rlimit none{0, 0};
  ::setrlimit(RLIMIT_CORE, &none);
  ::signal(SIGPROF, SIG_DFL);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // they need terabytes of it
  const rlimit memory{kHdf5MemoryBytes, kHdf5MemoryBytes};
  ::setrlimit(RLIMIT_AS, &memory);
#endif
}

herr_t isOutOfMemory(unsigned, const H5E_error2_t* error, void* found) {
  if (error->min_num == H5E_NOSPACE) *static_cast<bool*>(found) = true;
  return 0;
}

// Whether the last call of the library failed for want of memory.
bool ranOutOfMemory() {
  bool found = false;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, &isOutOfMemory, &found);
  return found;
}

}  // namespace

Hdf5Answers::Hdf5Answers(int descriptor) : chunkBytesLeft_(kAllKeptChunksBytes) {
  const auto lock = hdf5Lock();
  // Wherever a path leads, it stays in this file.
  H5Lunregister(H5L_TYPE_EXTERNAL);
  const std::string path = "/proc/self/fd/" + std::to_string(descriptor);
  file_ = Hdf5Id(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
}

std::string Hdf5Answers::answer(std::span<const std::byte> request) {
  const auto lock = hdf5Lock();
  ByteReader in(request);
  const auto wanted = static_cast<Hdf5Request>(in.u8());
  const std::string name = textFrom(in);
  std::string value;
  const auto put = [&](std::uint64_t number, int bytes) {
    appendLittleEndian(value, number, bytes);
  };
  try {
    if (!file_.ok()) fault("can't be opened as HDF5: it is cut off, damaged or being written");
    if (name.size() > kMaxNameBytes) fault("has too long a name");
    switch (wanted) {
      case Hdf5Request::kOpen:
        break;
      case Hdf5Request::kArrayNames:
        value = arrayNames();
        break;
      case Hdf5Request::kHas:
        put(has(name) ? 1 : 0, 1);
        break;
      case Hdf5Request::kFacts: {
        const Hdf5Facts& facts = array(name).facts;
        put(static_cast<std::uint8_t>(facts.kind), 1);
        appendText(value, facts.typeName);
        put(facts.shape.size(), 1);
        for (const std::uint64_t length : facts.shape) put(length, 8);
        put(facts.chunkLength, 8);
        appendText(value, facts.fault);
        break;
      }
      case Hdf5Request::kRead:
        value = numbers(name, in);
        break;
      case Hdf5Request::kTexts:
        value = texts(name, in);
        break;
      case Hdf5Request::kTextAttribute:
        attribute(name, in, [&](hid_t object, const char* key) {
          const auto text = readHdf5Text(object, key, static_cast<std::size_t>(in.u64()));
          put(text ? 1 : 0, 1);
          appendText(value, hdf5RestoredText(text.value_or("")));
        });
        break;
      case Hdf5Request::kIntegerAttribute:
        attribute(name, in, [&](hid_t object, const char* key) {
          const auto number = readHdf5Integer(object, key);
          put(number ? 1 : 0, 1);
          put(static_cast<std::uint64_t>(number.value_or(0)), 8);
        });
        break;
      case Hdf5Request::kNumberAttribute:
        attribute(name, in, [&](hid_t object, const char* key) {
          const auto number = readHdf5Number(object, key);
          put(number ? 1 : 0, 1);
          put(std::bit_cast<std::uint64_t>(number.value_or(0.0)), 8);
        });
        break;
      case Hdf5Request::kAxisNames:
        value = axisNames(name);
        break;
    }
  } catch (const Hdf5Fault& found) {
    if (ranOutOfMemory()) throw std::bad_alloc();
    return static_cast<char>(Hdf5Answer::kFault) + found.text;
  }
  return static_cast<char>(Hdf5Answer::kValue) + value;
}

std::string Hdf5Answers::arrayNames() {
  CollectedNames found;
  if (H5Ovisit2(file_.get(), H5_INDEX_NAME, H5_ITER_INC, &collectName, &found, H5O_INFO_BASIC) < 0)
    fault("is damaged: the HDF5 data sets can't be listed");
  std::string value;
  appendLittleEndian(value, found.names.size(), 4);
  for (const std::string& name : found.names) appendText(value, name);
  return value;
}

// Of a path every part must be there.
bool Hdf5Answers::has(const std::string& name) const {
  for (std::size_t slash = name.find('/', 1);; slash = name.find('/', slash + 1)) {
    if (H5Lexists(file_.get(), name.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) return false;
    requireInside(name.substr(0, slash));
    if (slash == std::string::npos) return true;
  }
}

void Hdf5Answers::requireInside(const std::string& name) const {
  H5L_info_t link{};
  if (H5Lget_info(file_.get(), name.c_str(), &link, H5P_DEFAULT) >= 0 &&
      link.type != H5L_TYPE_HARD && link.type != H5L_TYPE_SOFT)
    fault("is a link to another file (external link), which is refused");
}

Hdf5Answers::Array& Hdf5Answers::array(const std::string& name) {
  const auto known = arrays_.find(name);
  if (known != arrays_.end()) return known->second;
  if (!has(name)) fault("is missing");
  Array opened{openArray(file_.get(), name, {}), {}};
  opened.facts = factsOf(opened.id.get());
  return arrays_.emplace(name, std::move(opened)).first->second;
}

const Hdf5Answers::Array& Hdf5Answers::arrayToRead(const std::string& name) {
  Array& found = array(name);
  if (!found.facts.fault.empty()) fault(found.facts.fault);
  if (found.isReading) return found;
  found.isReading = true;
  const ChunkBand band = chunkBandOf(found.id.get(), found.facts);
  if (band.bytes == 0 || band.bytes > std::min<hsize_t>(kKeptChunksBytes, chunkBytesLeft_))
    return found;
  chunkBytesLeft_ -= static_cast<std::size_t>(band.bytes);
  found.id.reset();  // as long as it is open, the library keeps to what it was opened with
  found.id = openArray(file_.get(), name, band);
  return found;
}

std::string Hdf5Answers::numbers(const std::string& name, ByteReader& in) {
  const hsize_t first = in.u64();
  const hsize_t count = in.u64();
  const auto type = static_cast<Hdf5Number>(in.u8());
  const auto axis = static_cast<Hdf5Axis>(in.u8());
  if (!in.ok() || type > Hdf5Number::kF64 || axis > Hdf5Axis::kLast)
    fault("was requested incorrectly");
  const Array& from = arrayToRead(name);
  const Hdf5Id space(H5Dget_space(from.id.get()), H5Sclose);
  Hdf5Id memory;
  hsize_t bytes = sizeOf(type);
  for (const hsize_t size : selectRows(space.get(), from.facts, first, count, memory, axis))
    if (__builtin_mul_overflow(bytes, size, &bytes)) bytes = HSIZE_UNDEF;
  if (bytes >= kMaxHdf5ReadBytes) fault("has too many numbers per row");
  std::string value(static_cast<std::size_t>(bytes), '\0');
  if (bytes > 0 &&
      H5Dread(
          from.id.get(), memoryTypeOf(type), memory.get(), space.get(), H5P_DEFAULT, value.data()) <
          0)
    fault("can't be read: damaged or cut off");
  return value;
}

std::string Hdf5Answers::texts(const std::string& name, ByteReader& in) {
  const Array& from = arrayToRead(name);
  const hsize_t first = in.u64();
  const hsize_t count = in.u64();
  const std::uint64_t longest = in.u64();
  const Hdf5Id type(H5Dget_type(from.id.get()), H5Tclose);
  if (from.facts.shape.size() != 1 || from.facts.kind != Hdf5Kind::kText)
    fault("has texts of another type");
  const bool isVariable = H5Tis_variable_str(type.get()) > 0;
  const std::size_t fixedBytes = isVariable ? 0 : H5Tget_size(type.get());
  if (fixedBytes > longest) fault("has a text that is too long");
  std::string fixed(fixedBytes + 1, '\0');
  const Hdf5Id memoryType(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(memoryType.get(), isVariable ? H5T_VARIABLE : fixed.size());
  H5Tset_cset(memoryType.get(), H5Tget_cset(type.get()));
  const Hdf5Id space(H5Dget_space(from.id.get()), H5Sclose);
  Hdf5Id memory;
  std::string all;
  hsize_t read = 0;
  // One after the other, so that a hostile file can't ask for all memory at once.
  while (read < count && read < kTextsPerAnswer && all.size() < kTextsPerAnswerBytes) {
    selectRows(space.get(), from.facts, first + read, 1, memory);
    char* pointer = nullptr;
    if (H5Dread(from.id.get(),
                memoryType.get(),
                memory.get(),
                space.get(),
                H5P_DEFAULT,
                isVariable ? static_cast<void*>(&pointer) : fixed.data()) < 0)
      fault("can't be read: damaged or cut off");
    const std::string one = !isVariable ? fixed.c_str() : pointer ? pointer : "";
    H5free_memory(pointer);
    if (one.size() > longest) fault("has a text that is too long");
    appendText(all, hdf5RestoredText(one));
    ++read;
  }
  std::string value;
  appendLittleEndian(value, read, 4);
  return value + all;
}

std::string Hdf5Answers::axisNames(const std::string& name) {
  const Array& from = array(name);
  std::vector<std::string> names(from.facts.shape.size());
  if (!names.empty() && names.size() <= kMaxAxes) {
    readAxisLabels(from.id.get(), names);
    readAxisScales(from.id.get(), names);
  }
  if (std::all_of(names.begin(), names.end(), [](const auto& each) { return each.empty(); }))
    names.clear();
  std::string value;
  appendLittleEndian(value, names.size(), 4);
  for (const std::string& each : names) appendText(value, each);
  return value;
}

template <typename Read>
void Hdf5Answers::attribute(const std::string& name, ByteReader& in, Read read) {
  const std::string key = textFrom(in);
  if (!name.empty() && !has(name)) fault("is missing");
  const Hdf5Id object(name.empty() ? H5Oopen(file_.get(), "/", H5P_DEFAULT)
                                   : H5Oopen(file_.get(), name.c_str(), H5P_DEFAULT),
                      H5Oclose);
  if (!object.ok()) fault("can't be opened: damaged");
  read(object.get(), key.c_str());
}

int serveHdf5(int socket, int file, std::chrono::milliseconds requestCpu) {
  limitHdf5Process();
  limitNextRequest(requestCpu);
  try {
    Hdf5Answers answers(file);
    std::vector<std::byte> request;
    for (;;) {
      std::uint32_t size = 0;
      if (!receiveAll(socket, &size, sizeof size)) return 0;
      if (size > kMaxHdf5RequestBytes) return 1;
      request.resize(size);
      if (!receiveAll(socket, request.data(), size)) return 0;
      limitNextRequest(requestCpu);
      const std::string answer = answers.answer(request);
      std::string head;
      appendLittleEndian(head, answer.size(), 4);
      if (!sendAll(socket, head) || !sendAll(socket, answer)) return 0;
    }
  } catch (const std::bad_alloc&) {
    return kHdf5MemoryExitCode;
  }
}

}  // namespace palpate
