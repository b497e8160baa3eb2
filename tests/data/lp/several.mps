* The second N row, sets after the first of their kind, and a range on a dropped row do not count; the
* constant is minus the objective's RHS entry. max 2 x + 3 y + 7, x + y <= 4, x <= 3, y <= 2: 4 + 6 + 7 = 17.
NAME          SEVERAL
OBJSENSE MAX
ROWS
 N  GAIN
 L  SUM
 N  OTHER
COLUMNS
    X         GAIN                 2   OTHER              100
    X         SUM                  1
    Y         OTHER             -100   GAIN                 3
    Y         SUM                  1
    EMPTY     OTHER                1
RHS
    RHS1      SUM                  4   GAIN                -7
    RHS1      OTHER                9
    RHS2      SUM               4000
RANGES
    RNG       OTHER                1
BOUNDS
 UP B1        X                    3
 UP B1        Y                    2
 UP B2        X                   50
ENDATA
