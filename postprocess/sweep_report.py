"""Tables of a sweep: one row for each case, with errors, and observed orders."""

import csv
import json

import convergence

# What a run says of itself, in every table.
EFFORT = ("steps [-]", "wall time [s]", "cpu time [s]", "exit code")


def is_wanted(column, wanted):
    """Whether a column is one of those that the user named, in full with its
    unit or in part; or any that the run does not say of itself."""
    if wanted:
        return any(word == column if word.endswith("]") else word in column for word in wanted)
    return not column.startswith(("exit code", "wall time", "cpu time", "steps",
                                  "repeated steps"))


def error_name(column, reference):
    """The name of the column that compares another one with its reference."""
    if reference == 0:
        return f"error of {column}"
    return f"relative error of {column.rsplit(' [', 1)[0]} [-]"


def error(text, reference):
    """value / reference - 1, or the value where the reference is zero."""
    try:
        value = float(text)
    except ValueError:
        return ""
    return repr(value / reference - 1 if reference else value)


def table_rows(study, results, states):
    """The table as [{column: text}]: series, entries, results, errors, effort.

    @p results is {case: row of result.csv}, @p states {case: row of effort},
    which replaces the columns of the same name."""
    entries = list(dict.fromkeys(e for values in study.cases.values() for e in values))
    columns = [c for c in dict.fromkeys(c for row in results.values() for c in row)
               if not c.startswith("exit code") and c not in EFFORT
               and (not study.columns or is_wanted(c, study.columns))]
    compared = dict.fromkeys(pair for series in study.series
                             for pair in series.references.items())
    errors = list(dict.fromkeys(error_name(*pair) for pair in compared))
    rows = []
    for series, name in study.rows:
        row = {"series": series.name} if len(study.series) > 1 else {}
        row.update({e: study.cases[name].get(e, "") for e in entries})
        found = results.get(name, {})
        row.update({c: found.get(c, "") for c in columns})
        row.update(dict.fromkeys(errors, ""))
        for column, reference in series.references.items():
            row[error_name(column, reference)] = error(found.get(column, ""), reference)
        effort = {**{c: found.get(c, "") for c in EFFORT}, **states.get(name, {})}
        row.update({c: effort[c] for c in EFFORT})
        rows.append(row)
    return rows


def write_table(path, rows):
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, rows[0])
        writer.writeheader()
        writer.writerows(rows)
    print(f"table: {path}")


def observed_orders(h, x, column, references):
    """(kind, orders, limit) of one column over the refined cases."""
    if column in references:
        errors = [value - references[column] for value in x]
        return "reference", convergence.order_of_errors(h, errors), references[column]
    if "error" in column.lower():
        return "error", convergence.order_of_errors(h, x), 0.0
    triples = [convergence.three_grid_order(h[k:k + 3], x[k:k + 3])
               for k in range(len(h) - 2)]
    return "three grids", [p for p, _ in triples], triples[-1][1] if triples else None


def order_rows(label, h, names, results, series, wanted):
    """Rows of orders.csv of one refinement; they are printed as well."""
    rows = []
    print("orders: " + (label or "over the refinement"))
    for column in results[names[0]]:
        if not is_wanted(column, wanted):
            continue
        try:
            x = [float(results[name][column]) for name in names]
        except (KeyError, ValueError):
            continue
        kind, orders, limit = observed_orders(h, x, column, series.references)
        texts = ["-" if p is None else f"{p:.2f}" for p in orders]
        print(f"  {column}: {', '.join(f'{value:.8g}' for value in x)}; order "
              f"({kind}) {', '.join(texts) or '-'}"
              + ("" if limit is None else f"; limit {limit:.8g}"))
        rows.append((label, column, kind, x, texts, limit))
    return rows


def report_orders(path, study, results):
    """Prints the orders of all refined series and writes orders.csv."""
    rows = []
    for series in study.series:
        if not series.refined:
            continue
        groups = {}
        for one, name in study.rows:
            if one is series:
                rest = {e: v for e, v in study.cases[name].items() if e not in series.refined[0]}
                groups.setdefault(json.dumps(rest), []).append(name)
        for key, names in groups.items():
            label = series.name or ", ".join(f"{e} = {v}" for e, v in json.loads(key).items())
            if all(name in results for name in names):
                rows += order_rows(label, series.sizes(), names, results, series, study.columns)
            else:
                print(f"orders: {label or 'the refinement'} is not complete")
    n_values = max((len(x) for _, _, _, x, _, _ in rows), default=0)
    n_orders = max((len(texts) for _, _, _, _, texts, _ in rows), default=0)
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(["case", "column", "kind"] + [f"value {k + 1}" for k in range(n_values)]
                        + [f"order {k + 1}" for k in range(n_orders)] + ["limit"])
        for label, column, kind, x, texts, limit in rows:
            writer.writerow([label, column, kind] + x + [""] * (n_values - len(x)) + texts
                            + [""] * (n_orders - len(texts)) + ["" if limit is None else limit])
