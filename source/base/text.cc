#include "ephyra/base/text.h"

#include <algorithm>
#include <cctype>
#include <charconv>

namespace ephyra::text
{
  namespace
  {
    char
    lower(const char c)
    {
      return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
  } // namespace

  std::string
  normalize(const std::string &text)
  {
    std::string result;
    bool        blank = false;
    for (std::size_t i = 0; i < text.size(); ++i)
      {
        const bool no_break_space =
          text.compare(i, 2, "\xC2\xA0") == 0; // as pasted from documents
        if (no_break_space || std::isspace(static_cast<unsigned char>(text[i])))
          {
            blank = true;
            i += no_break_space ? 1 : 0;
            continue;
          }
        if (blank && !result.empty())
          result += ' ';
        blank = false;
        result += text[i];
      }
    return result;
  }

  std::vector<std::string>
  split_list(const std::string &text)
  {
    std::vector<std::string> items;
    if (normalize(text).empty())
      return items;
    std::string item;
    int         depth = 0;
    for (const char c : text)
      {
        depth += (c == '(') - (c == ')');
        if (c == ',' && depth <= 0)
          {
            items.push_back(normalize(item));
            item.clear();
          }
        else
          item += c;
      }
    items.push_back(normalize(item));
    return items;
  }

  std::string
  quote(const std::string &text)
  {
    return '"' + text + '"';
  }

  std::string
  quoted_list(const std::vector<std::string> &names)
  {
    std::string result;
    for (const std::string &name : names)
      result += (result.empty() ? "" : ", ") + quote(name);
    return result;
  }

  std::string
  number(const double x)
  {
    char       buffer[64];
    const auto end = std::to_chars(buffer, buffer + sizeof(buffer), x).ptr;
    return std::string(buffer, end);
  }

  unsigned int
  edit_distance(const std::string &a, const std::string &b)
  {
    // Three rows of the table of distances between the beginnings of a and b.
    const std::size_t         n = b.size();
    std::vector<unsigned int> before_last(n + 1), last(n + 1), row(n + 1);
    for (std::size_t j = 0; j <= n; ++j)
      row[j] = static_cast<unsigned int>(j);
    for (std::size_t i = 1; i <= a.size(); ++i)
      {
        before_last.swap(last);
        last.swap(row);
        row[0] = static_cast<unsigned int>(i);
        for (std::size_t j = 1; j <= n; ++j)
          {
            const char         x = lower(a[i - 1]), y = lower(b[j - 1]);
            const unsigned int replaced = last[j - 1] + (x == y ? 0 : 1);
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, replaced});
            if (i > 1 && j > 1 && x == lower(b[j - 2]) && lower(a[i - 2]) == y)
              row[j] = std::min(row[j], before_last[j - 2] + 1);
          }
      }
    return row[n];
  }

  std::string
  nearest(const std::string &name, const std::vector<std::string> &candidates)
  {
    std::string  best;
    unsigned int best_distance = 0;
    for (const std::string &candidate : candidates)
      {
        const std::size_t  length   = std::max(name.size(), candidate.size());
        const unsigned int distance = edit_distance(name, candidate);
        if (3 * distance <= length &&
            (best.empty() || distance < best_distance))
          {
            best          = candidate;
            best_distance = distance;
          }
      }
    return best;
  }

  std::string
  suggestion(const std::string              &name,
             const std::vector<std::string> &candidates,
             const std::string              &kind)
  {
    const std::string best = nearest(name, candidates);
    if (!best.empty())
      return "did you mean " + quote(best) + "?";
    if (candidates.empty())
      return "there are no " + kind + " here";
    return "valid " + kind + " are " + quoted_list(candidates);
  }
} // namespace ephyra::text
