#include "ephyra/io/vtk_writer.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/mpi.h"
#include "ephyra/io/collective.h"
#include "ephyra/io/vtk_xml.h"

#include <algorithm>
#include <filesystem>
#include <utility>

namespace ephyra::io
{
  namespace
  {
    constexpr std::uint8_t vtk_bezier_curve         = 75;
    constexpr std::uint8_t vtk_bezier_quadrilateral = 77;

    void
    add_array(VtkXml                   &file,
              const std::string        &name,
              const int                 n_components,
              const std::vector<float> &values)
    {
      file.add_array("Float32",
                     name,
                     n_components,
                     values.data(),
                     values.size() * sizeof(float));
    }

    void
    add_array(VtkXml                    &file,
              const std::string         &name,
              const int                  n_components,
              const std::vector<double> &values)
    {
      file.add_array("Float64",
                     name,
                     n_components,
                     values.data(),
                     values.size() * sizeof(double));
    }

    /// Interleaves the components and turns the cells around: VTK runs along
    /// x (our rows) fastest. Tiled, as one of the two orders strides.
    std::vector<float>
    to_vtk_order(const GridField &field, const int n_rows, const int n_y)
    {
      constexpr int tile         = 32;
      const int     n_components = static_cast<int>(field.components.size());
      std::vector<float> result(std::size_t(n_rows) * n_y * n_components);
      for (int c = 0; c < n_components; ++c)
        {
          const double *const values = field.components[c].data();
          for (int j0 = 0; j0 < n_y; j0 += tile)
            for (int i = 0; i < n_rows; ++i)
              for (int j = j0; j < std::min(j0 + tile, n_y); ++j)
                result[(std::size_t(j) * n_rows + i) * n_components + c] =
                  static_cast<float>(values[std::size_t(i) * n_y + j]);
        }
      return result;
    }

    std::string
    extent(const std::int64_t first_row,
           const std::int64_t n_rows,
           const std::size_t  n_y)
    {
      return std::to_string(first_row) + " " +
             std::to_string(first_row + n_rows) + " 0 " + std::to_string(n_y) +
             " 0 0";
    }

    void
    write_piece(const std::string &file_name, const GridOutput &output)
    {
      const std::size_t n_r = output.r_faces.size() - 1,
                        n_y = output.y_faces.size() - 1;
      VtkXml file("RectilinearGrid");
      file.xml << " WholeExtent=\"" << extent(0, n_r, n_y)
               << "\">\n<Piece Extent=\""
               << extent(output.first_row, output.n_rows, n_y)
               << "\">\n<CellData>\n";
      for (const GridField &field : output.fields)
        add_array(file,
                  field.name,
                  static_cast<int>(field.components.size()),
                  to_vtk_order(field, output.n_rows, n_y));
      file.xml << "</CellData>\n<Coordinates>\n";
      const auto first = output.r_faces.begin() + output.first_row;
      add_array(file,
                "r [m]",
                1,
                std::vector<double>(first, first + output.n_rows + 1));
      add_array(file, "y [m]", 1, output.y_faces);
      add_array(file, "z [m]", 1, std::vector<double>{0.});
      file.xml << "</Coordinates>\n</Piece>\n";
      file.finish(file_name);
    }

    /// The file that lists the pieces; @p rows are first row and number of
    /// rows of every rank.
    std::string
    list_of_pieces(const std::string               &stem,
                   const GridOutput                &output,
                   const std::vector<std::int64_t> &rows)
    {
      const std::size_t n_r   = output.r_faces.size() - 1,
                        n_y   = output.y_faces.size() - 1;
      const std::string  name = std::filesystem::path(stem).filename().string();
      std::ostringstream xml;
      xml << "<?xml version=\"1.0\"?>\n<VTKFile type=\"PRectilinearGrid\""
          << " version=\"1.0\" byte_order=\"LittleEndian\""
          << " header_type=\"UInt64\">\n"
          << "<PRectilinearGrid WholeExtent=\"" << extent(0, n_r, n_y)
          << "\" GhostLevel=\"0\">\n<PCellData>\n";
      for (const GridField &field : output.fields)
        xml << "<PDataArray type=\"Float32\" Name=\"" << xml_escape(field.name)
            << "\" NumberOfComponents=\"" << field.components.size()
            << "\"/>\n";
      xml << "</PCellData>\n<PCoordinates>\n";
      for (const char *const axis : {"r [m]", "y [m]", "z [m]"})
        xml << "<PDataArray type=\"Float64\" Name=\"" << axis << "\"/>\n";
      xml << "</PCoordinates>\n";
      for (std::size_t rank = 0; rank < rows.size() / 2; ++rank)
        if (rows[2 * rank + 1] > 0)
          xml << "<Piece Extent=\""
              << extent(rows[2 * rank], rows[2 * rank + 1], n_y)
              << "\" Source=\"" << xml_escape(name) << "_" << rank
              << ".vtr\"/>\n";
      xml << "</PRectilinearGrid>\n</VTKFile>\n";
      return xml.str();
    }
  } // namespace

  void
  write_flow(const std::string &stem,
             const GridOutput  &output,
             const MPI_Comm     comm)
  {
    const int rank = mpi::rank(comm);
    on_every_rank(comm, [&]() {
      if (output.n_rows > 0)
        write_piece(stem + "_" + std::to_string(rank) + ".vtr", output);
    });

    const std::int64_t        mine[2] = {output.first_row, output.n_rows};
    std::vector<std::int64_t> rows(2 * mpi::size(comm));
    MPI_Gather(mine, 2, MPI_INT64_T, rows.data(), 2, MPI_INT64_T, 0, comm);
    on_first_rank(comm, [&]() {
      replace_file(stem + ".pvtr", list_of_pieces(stem, output, rows));
    });
  }

  std::vector<int>
  vtk_bezier_order(const int                 parametric_dimension,
                   const std::array<int, 2> &degree)
  {
    const int        p = degree[0];
    std::vector<int> order;
    if (parametric_dimension == 1)
      {
        order = {0, p};
        for (int i = 1; i < p; ++i)
          order.push_back(i);
        return order;
      }

    const int  q     = degree[1];
    const auto index = [p](const int i, const int j) {
      return j * (p + 1) + i;
    };
    order = {index(0, 0), index(p, 0), index(p, q), index(0, q)};
    for (int i = 1; i < p; ++i)
      order.push_back(index(i, 0));
    for (int j = 1; j < q; ++j)
      order.push_back(index(p, j));
    for (int i = 1; i < p; ++i)
      order.push_back(index(i, q));
    for (int j = 1; j < q; ++j)
      order.push_back(index(0, j));
    for (int j = 1; j < q; ++j)
      for (int i = 1; i < p; ++i)
        order.push_back(index(i, j));
    return order;
  }

  namespace
  {
    /// Points of all cells in turn, and where those of each cell end.
    void
    add_cells(VtkXml                          &file,
              const std::vector<std::int64_t> &connectivity,
              const std::vector<std::int64_t> &offsets)
    {
      for (const auto &[name, values] :
           {std::make_pair("connectivity", &connectivity),
            std::make_pair("offsets", &offsets)})
        file.add_array("Int64",
                       name,
                       1,
                       values->data(),
                       values->size() * sizeof(std::int64_t));
    }

    void
    write_bezier_cells(const std::string &file_name, const BezierOutput &output)
    {
      const std::vector<int> order =
        vtk_bezier_order(output.parametric_dimension, output.degree);
      const std::size_t n_local = order.size(), n_points = output.r.size(),
                        n_cells = n_points / n_local;
      EphyraAssert(n_cells * n_local == n_points &&
                     output.y.size() == n_points &&
                     output.weight.size() == n_points,
                   "a Bézier cell lacks control points");

      // Points are written lexicographically; the cells do the reordering.
      std::vector<double> points;
      points.reserve(3 * n_points);
      for (std::size_t k = 0; k < n_points; ++k)
        points.insert(points.end(), {output.r[k], output.y[k], 0.});

      std::vector<std::int64_t> connectivity, offsets;
      for (std::size_t cell = 0; cell < n_cells; ++cell)
        {
          for (const int k : order)
            connectivity.push_back(cell * n_local + k);
          offsets.push_back((cell + 1) * n_local);
        }
      const bool                      curve = output.parametric_dimension == 1;
      const std::vector<std::uint8_t> types(
        n_cells, curve ? vtk_bezier_curve : vtk_bezier_quadrilateral);
      std::vector<double> degrees;
      for (std::size_t cell = 0; cell < n_cells; ++cell)
        degrees.insert(degrees.end(),
                       {double(output.degree[0]),
                        curve ? 0. : double(output.degree[1]),
                        0.});

      VtkXml file("UnstructuredGrid");
      file.xml << ">\n<Piece NumberOfPoints=\"" << n_points
               << "\" NumberOfCells=\"" << n_cells
               << "\">\n<PointData RationalWeights=\"RationalWeights\">\n";
      add_array(file, "RationalWeights", 1, output.weight);
      for (const BezierField &field : output.point_fields)
        add_array(file,
                  field.name,
                  field.n_components,
                  std::vector<float>(field.values.begin(), field.values.end()));
      file.xml << "</PointData>\n"
               << "<CellData HigherOrderDegrees=\"HigherOrderDegrees\">\n";
      add_array(file, "HigherOrderDegrees", 3, degrees);
      file.xml << "</CellData>\n<Points>\n";
      add_array(file, "Points", 3, points);
      file.xml << "</Points>\n<Cells>\n";
      add_cells(file, connectivity, offsets);
      file.add_array("UInt8", "types", 1, types.data(), types.size());
      file.xml << "</Cells>\n</Piece>\n";
      file.finish(file_name);
    }
  } // namespace

  void
  write_body(const std::string  &stem,
             const BezierOutput &output,
             const MPI_Comm      comm)
  {
    on_first_rank(comm, [&]() { write_bezier_cells(stem + ".vtu", output); });
  }

  namespace
  {
    void
    write_point_cloud(const std::string &file_name, const PointOutput &output)
    {
      const std::size_t   n = output.r.size();
      std::vector<double> points;
      points.reserve(3 * n);
      for (std::size_t k = 0; k < n; ++k)
        points.insert(points.end(), {output.r[k], output.y[k], 0.});
      std::vector<std::int64_t> connectivity, offsets;
      for (std::size_t k = 0; k < n; ++k)
        {
          connectivity.push_back(k);
          offsets.push_back(k + 1);
        }
      VtkXml file("PolyData");
      file.xml << ">\n<Piece NumberOfPoints=\"" << n << "\" NumberOfVerts=\""
               << n << "\">\n<PointData>\n";
      for (const PointOutput::Field &field : output.fields)
        add_array(file, field.name, 1, field.values);
      file.xml << "</PointData>\n<Points>\n";
      add_array(file, "Points", 3, points);
      file.xml << "</Points>\n<Verts>\n";
      add_cells(file, connectivity, offsets);
      file.xml << "</Verts>\n</Piece>\n";
      file.finish(file_name);
    }
  } // namespace

  void
  write_points(const std::string &stem,
               const PointOutput &output,
               const MPI_Comm     comm)
  {
    on_first_rank(comm, [&]() { write_point_cloud(stem + ".vtp", output); });
  }
} // namespace ephyra::io
