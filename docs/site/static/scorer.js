// Pages rank before entries of the references: who searches a word wants the page that explains it.
var Scorer = {
  objNameMatch: 8,
  objPartialMatch: 3,
  objPrio: {0: 4, 1: 2, 2: -2},
  objPrioDefault: 0,
  title: 25,
  partialTitle: 12,
  term: 5,
  partialTerm: 2,
};
