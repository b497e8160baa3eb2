NAME          BLANKS
ROWS
 N  COST ROW
 G  ROW A
COLUMNS
    COL ONE   COST ROW             2   ROW A                1
    COL TWO   COST ROW             3   ROW A                1
RHS
              ROW A                4
BOUNDS
 UP           COL ONE              1
ENDATA
