"use strict";
// Columns of words are left-aligned, those of many words in lines. A heading sorts its column: numbers by value, other cells as text; a second time in reverse.
for (const table of document.querySelectorAll("table.sorts")) {
  const heads = [...table.tHead.rows[0].cells], body = table.tBodies[0];
  heads.forEach((head, column) => {
    const key = (row) => row.cells[column].textContent;
    const value = (row) => Number(key(row).replace(/ ?%$/, ""));
    const isNumber = [...body.rows].every((row) => ["", "-", "noise"].includes(key(row)) || Number.isFinite(value(row)));
    if (!isNumber) {
      const isLong = [...body.rows].some((row) => key(row).length > 30 && key(row).includes(" "));
      for (const row of [table.tHead.rows[0], ...body.rows]) row.cells[column].className = isLong ? "words long" : "words";
    }
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = head.textContent;
    head.replaceChildren(button);
    head.setAttribute("aria-sort", "none");
    button.addEventListener("click", () => {
      const falls = head.getAttribute("aria-sort") === "ascending";
      for (const other of heads) other.setAttribute("aria-sort", other !== head ? "none" : falls ? "descending" : "ascending");
      const order = (a, b) => isNumber ? (value(a) || 0) - (value(b) || 0) : key(a) < key(b) ? -1 : key(a) > key(b) ? 1 : 0;
      body.append(...[...body.rows].sort((a, b) => falls ? order(b, a) : order(a, b)));
    });
  });
}
document.body.dataset.ready = "yes";
