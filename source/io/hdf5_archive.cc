#include "ephyra/io/hdf5_archive.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/mpi.h"
#include "ephyra/io/collective.h"

#include <hdf5.h>
#include <zlib.h>

#include <filesystem>

namespace ephyra::io
{
  namespace
  {
    /// An HDF5 object that is closed at the end of its scope.
    class Handle
    {
    public:
      Handle(const hid_t id, herr_t (*const close)(hid_t))
        : id(id)
        , close(close)
      {
      }
      ~Handle()
      {
        if (id >= 0)
          close(id);
      }
      Handle(const Handle &) = delete;
      Handle &
      operator=(const Handle &) = delete;
      operator hid_t() const
      {
        return id;
      }

    private:
      const hid_t id;
      herr_t (*const close)(hid_t);
    };

    constexpr const char *checksum_name = "checksum";

    std::uint64_t
    checksum_of_row(const std::uint64_t row,
                    const void         *data,
                    const std::size_t   n_bytes)
    {
      const uLong seed =
        crc32_z(0, reinterpret_cast<const Bytef *>(&row), sizeof(row));
      return n_bytes == 0
               ? seed
               : crc32_z(seed, static_cast<const Bytef *>(data), n_bytes);
    }

    /// Sum over rows, so that it does not depend on who holds which.
    std::uint64_t
    checksum_of_rows(const double *const data, const RowLayout &layout)
    {
      std::uint64_t sum = 0;
      for (std::int64_t i = 0; i < layout.n_rows; ++i)
        sum += checksum_of_row(layout.first_row + i,
                               data + i * layout.row_stride,
                               layout.n_columns * sizeof(double));
      return sum;
    }

    bool
    write_checksum(const hid_t dataset, const std::uint64_t checksum)
    {
      const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
      const Handle attribute(H5Acreate2(dataset,
                                        checksum_name,
                                        H5T_NATIVE_UINT64,
                                        space,
                                        H5P_DEFAULT,
                                        H5P_DEFAULT),
                             H5Aclose);
      return H5Awrite(attribute, H5T_NATIVE_UINT64, &checksum) >= 0;
    }

    bool
    has_checksum(const hid_t dataset, const std::uint64_t expected)
    {
      const Handle  attribute(H5Aopen(dataset, checksum_name, H5P_DEFAULT),
                             H5Aclose);
      std::uint64_t found = 0;
      return H5Aread(attribute, H5T_NATIVE_UINT64, &found) >= 0 &&
             found == expected;
    }

    /// Creates a dataset and the groups above it; collective.
    hid_t
    create_dataset(const hid_t        file,
                   const std::string &name,
                   const hid_t        type,
                   const hid_t        space)
    {
      const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
      H5Pset_create_intermediate_group(links, 1);
      return H5Dcreate2(
        file, name.c_str(), type, space, links, H5P_DEFAULT, H5P_DEFAULT);
    }

    /// Selects the rows of a rank, in the file and in memory.
    void
    select_rows(const hid_t      in_file,
                const hid_t      in_memory,
                const RowLayout &layout)
    {
      const hsize_t count[2] = {hsize_t(layout.n_rows),
                                hsize_t(layout.n_columns)};
      const hsize_t start[2] = {hsize_t(layout.first_row), 0};
      const hsize_t zero[2]  = {0, 0};
      if (layout.n_rows > 0)
        {
          H5Sselect_hyperslab(
            in_file, H5S_SELECT_SET, start, nullptr, count, nullptr);
          H5Sselect_hyperslab(
            in_memory, H5S_SELECT_SET, zero, nullptr, count, nullptr);
        }
      else
        {
          H5Sselect_none(in_file);
          H5Sselect_none(in_memory);
        }
    }

    hid_t
    memory_space(const RowLayout &layout)
    {
      const hsize_t size[2] = {hsize_t(layout.n_rows),
                               hsize_t(layout.row_stride)};
      return H5Screate_simple(2, size, nullptr);
    }
  } // namespace

  Hdf5Archive::Hdf5Archive(const std::string &file_name,
                           const Mode         mode,
                           const MPI_Comm     comm)
    : file_name(file_name)
    , mode(mode)
    , comm(comm)
  {
    // Errors are reported by us, in one sentence.
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);

    if (mode == Mode::read)
      on_first_rank(comm, [&]() {
        EphyraThrowIf(!std::filesystem::exists(file_name),
                      InputError,
                      message("it does not exist; check the name"));
        const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
        H5Pset_file_locking(access, false, true);
        const Handle probe(H5Fopen(file_name.c_str(), H5F_ACC_RDONLY, access),
                           H5Fclose);
        EphyraThrowIf(probe < 0,
                      InputError,
                      message("it is truncated or not an HDF5 file; "
                              "use another checkpoint"));
      });

    const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_fapl_mpio(access, comm, MPI_INFO_NULL);
    H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
    file = mode == Mode::read
             ? H5Fopen(file_name.c_str(), H5F_ACC_RDONLY, access)
             : H5Fcreate(file_name.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
    EphyraThrowIf(mpi::any(file < 0, comm),
                  InputError,
                  message(mode == Mode::read
                            ? "it cannot be opened; use another checkpoint"
                            : "it cannot be created; check the permissions and "
                              "the free space of the folder"));
  }

  Hdf5Archive::~Hdf5Archive()
  {
    if (file >= 0)
      H5Fclose(file);
  }

  void
  Hdf5Archive::close()
  {
    bool failed = H5Fflush(file, H5F_SCOPE_GLOBAL) < 0;
    failed      = H5Fclose(file) < 0 || failed;
    file        = -1;
    if (mode == Mode::write)
      check_write(failed, "the end of the file");
  }

  bool
  Hdf5Archive::reading() const
  {
    return mode == Mode::read;
  }

  bool
  Hdf5Archive::contains(const std::string &name)
  {
    return mpi::any(H5Lexists(file, full_name(name).c_str(), H5P_DEFAULT) > 0,
                    comm);
  }

  std::string
  Hdf5Archive::full_name(const std::string &name) const
  {
    std::string result;
    for (const std::string &group : groups)
      result += group + "/";
    return result + name;
  }

  std::string
  Hdf5Archive::message(const std::string &what) const
  {
    return "Checkpoint " + file_name + ": " + what + ".";
  }

  void
  Hdf5Archive::check_write(const bool failed, const std::string &name) const
  {
    EphyraThrowIf(mpi::any(failed, comm),
                  InputError,
                  message("writing " + name +
                          " failed; check the free space of the folder"));
  }

  void
  Hdf5Archive::write_replicated(const std::string &name, const Buffer &buffer)
  {
    const hsize_t     size    = buffer.n_values;
    const std::size_t n_bytes = buffer.n_values * buffer.value_size;
    const Handle      space(H5Screate_simple(1, &size, nullptr), H5Sclose);
    const Handle      dataset(
      create_dataset(file, full_name(name), buffer.type, space), H5Dclose);
    // The first rank's values count, and so does its checksum.
    std::uint64_t checksum = checksum_of_row(0, buffer.data, n_bytes);
    MPI_Bcast(&checksum, 1, MPI_UINT64_T, 0, comm);
    bool failed = dataset < 0 || !write_checksum(dataset, checksum);
    if (!failed && n_bytes > 0 && mpi::rank(comm) == 0)
      failed =
        H5Dwrite(
          dataset, buffer.type, H5S_ALL, H5S_ALL, H5P_DEFAULT, buffer.data) < 0;
    check_write(failed, full_name(name));
  }

  std::uint64_t
  Hdf5Archive::stored_size(const std::string &name)
  {
    std::uint64_t size = 0;
    on_first_rank(comm, [&]() {
      const Handle dataset(H5Dopen2(file, full_name(name).c_str(), H5P_DEFAULT),
                           H5Dclose);
      EphyraThrowIf(dataset < 0,
                    InputError,
                    message("it does not hold " + full_name(name) +
                            ", which this version needs; use the version "
                            "that wrote it"));
      const Handle   space(H5Dget_space(dataset), H5Sclose);
      const hssize_t n_values = H5Sget_simple_extent_npoints(space);
      EphyraThrowIf(n_values < 0,
                    InputError,
                    message(full_name(name) + " is damaged; use another "
                                              "checkpoint"));
      size = n_values;
    });
    MPI_Bcast(&size, 1, MPI_UINT64_T, 0, comm);
    return size;
  }

  void
  Hdf5Archive::read_replicated(const std::string &name, const Buffer &buffer)
  {
    const std::uint64_t size = stored_size(name);
    EphyraThrowIf(size != buffer.n_values,
                  InputError,
                  message(full_name(name) + " has " + std::to_string(size) +
                          " values, the scene has " +
                          std::to_string(buffer.n_values) +
                          "; resume with the scene that wrote it"));
    const std::size_t n_bytes = buffer.n_values * buffer.value_size;
    on_first_rank(comm, [&]() {
      const Handle dataset(H5Dopen2(file, full_name(name).c_str(), H5P_DEFAULT),
                           H5Dclose);
      const bool   read =
        n_bytes == 0 ||
        H5Dread(
          dataset, buffer.type, H5S_ALL, H5S_ALL, H5P_DEFAULT, buffer.data) >=
          0;
      EphyraThrowIf(
        !read ||
          !has_checksum(dataset, checksum_of_row(0, buffer.data, n_bytes)),
        InputError,
        message(full_name(name) + " is damaged; use another checkpoint"));
    });
    MPI_Bcast(buffer.data, static_cast<int>(n_bytes), MPI_BYTE, 0, comm);
  }

  void
  Hdf5Archive::value(const std::string &name, double &x)
  {
    const Buffer buffer = {H5T_NATIVE_DOUBLE, sizeof(x), 1, &x};
    reading() ? read_replicated(name, buffer) : write_replicated(name, buffer);
  }

  void
  Hdf5Archive::value(const std::string &name, std::int64_t &x)
  {
    const Buffer buffer = {H5T_NATIVE_INT64, sizeof(x), 1, &x};
    reading() ? read_replicated(name, buffer) : write_replicated(name, buffer);
  }

  void
  Hdf5Archive::values(const std::string &name, std::vector<double> &x)
  {
    if (reading())
      x.resize(stored_size(name));
    const Buffer buffer = {
      H5T_NATIVE_DOUBLE, sizeof(double), x.size(), x.data()};
    reading() ? read_replicated(name, buffer) : write_replicated(name, buffer);
  }

  void
  Hdf5Archive::text(const std::string &name, std::string &x)
  {
    if (reading())
      x.resize(stored_size(name));
    const Buffer buffer = {H5T_NATIVE_CHAR, 1, x.size(), x.data()};
    reading() ? read_replicated(name, buffer) : write_replicated(name, buffer);
  }

  void
  Hdf5Archive::rows(const std::string &name,
                    double *const      data,
                    const RowLayout   &layout)
  {
    reading() ? read_rows(name, data, layout) : write_rows(name, data, layout);
  }

  void
  Hdf5Archive::write_rows(const std::string  &name,
                          const double *const data,
                          const RowLayout    &layout)
  {
    const hsize_t size[2] = {hsize_t(layout.n_global_rows),
                             hsize_t(layout.n_columns)};
    const Handle  in_file(H5Screate_simple(2, size, nullptr), H5Sclose);
    const Handle  in_memory(memory_space(layout), H5Sclose);
    const Handle  dataset(
      create_dataset(file, full_name(name), H5T_NATIVE_DOUBLE, in_file),
      H5Dclose);
    std::uint64_t checksum = checksum_of_rows(data, layout);
    MPI_Allreduce(MPI_IN_PLACE, &checksum, 1, MPI_UINT64_T, MPI_SUM, comm);
    bool failed = dataset < 0 || !write_checksum(dataset, checksum);

    select_rows(in_file, in_memory, layout);
    const Handle transfer(H5Pcreate(H5P_DATASET_XFER), H5Pclose);
    H5Pset_dxpl_mpio(transfer, H5FD_MPIO_COLLECTIVE);
    failed =
      H5Dwrite(dataset, H5T_NATIVE_DOUBLE, in_memory, in_file, transfer, data) <
        0 ||
      failed;
    check_write(failed, full_name(name));
  }

  void
  Hdf5Archive::read_rows(const std::string &name,
                         double *const      data,
                         const RowLayout   &layout)
  {
    stored_size(name); // reports a missing name
    const Handle dataset(H5Dopen2(file, full_name(name).c_str(), H5P_DEFAULT),
                         H5Dclose);
    const Handle in_file(H5Dget_space(dataset), H5Sclose);
    hsize_t      size[2] = {0, 0};
    if (H5Sget_simple_extent_ndims(in_file) == 2)
      H5Sget_simple_extent_dims(in_file, size, nullptr);
    EphyraThrowIf(mpi::any(size[0] != hsize_t(layout.n_global_rows) ||
                             size[1] != hsize_t(layout.n_columns),
                           comm),
                  InputError,
                  message(full_name(name) + " has " + std::to_string(size[0]) +
                          " x " + std::to_string(size[1]) +
                          " values, the scene has " +
                          std::to_string(layout.n_global_rows) + " x " +
                          std::to_string(layout.n_columns) +
                          "; resume with the scene that wrote it"));

    const Handle in_memory(memory_space(layout), H5Sclose);
    select_rows(in_file, in_memory, layout);
    const bool failed =
      H5Dread(
        dataset, H5T_NATIVE_DOUBLE, in_memory, in_file, H5P_DEFAULT, data) < 0;
    std::uint64_t checksum = checksum_of_rows(data, layout);
    MPI_Allreduce(MPI_IN_PLACE, &checksum, 1, MPI_UINT64_T, MPI_SUM, comm);
    EphyraThrowIf(
      mpi::any(failed || !has_checksum(dataset, checksum), comm),
      InputError,
      message(full_name(name) + " is damaged; use another checkpoint"));
  }

  void
  Hdf5Archive::enter(const std::string &group)
  {
    groups.push_back(group);
  }

  void
  Hdf5Archive::leave()
  {
    EphyraAssert(!groups.empty(), "leave() without enter()");
    groups.pop_back();
  }
} // namespace ephyra::io
